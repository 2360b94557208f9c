// The mechanics: conduction and waves as tests/mpm has them, and shape functions, by which
// particles anywhere in the grid read known fields.
#include "launchsafe/mpm/transfer.hpp"
#include "mpm/exact_solutions.hpp"
#include "series.hpp"

#include <cmath>
#include <numbers>

namespace launchsafe::error_of_parts {
namespace {

using namespace test_support;
using math::Pack;

constexpr double length = 0.16, radius = 0.02;  // m, of a block

/// A velocity v_x(x, r) and its slope along x.
struct Field {
  double (*value)(double x, double r);
  double (*slope)(double x, double r);
};

constexpr double wave_number = 2.0 * std::numbers::pi / length;
constexpr Field linear{[](double x, double) { return 3.0 + 20.0 * x; }, [](double, double) { return 20.0; }};
constexpr Field wave{[](double x, double) { return std::sin(wave_number * x); },
                     [](double x, double) { return wave_number * std::cos(wave_number * x); }};

/// Errors of what the particles read, root mean square, over that of the exact value.
struct ReadError {
  double value = 0, slope = 0;
};

mpm::Grid grid_with(const Field& field, double cell) {
  mpm::Grid grid = mpm::make_grid(block("steel", length, radius, cell));
  for (int j = 0; j < grid.nodes_r; ++j) {
    for (int i = 0; i < grid.nodes_x; ++i) {
      const double x = grid.origin_x + i * grid.dx, r = (j - mpm::Grid::radial_padding) * grid.dr;
      grid.velocity_x[grid.index(i, j)] = field.value(x, r);
    }
  }
  return grid;
}

/// Numbers in [0, 1) that fill it evenly: multiples of the golden ratio.
double even_share(int k) {
  const double golden = k * std::numbers::phi;
  return golden - std::floor(golden);
}

constexpr int particles = 4096;

/// 4096 particles of half a cell's length, anywhere in their cells: in Packs one cell apart, as in a body,
/// the same number in every cell along x.
ReadError read_error(const Field& field, const mpm::Grid& grid) {
  const double half_x = 0.25 * grid.dx, half_r = 0.25 * grid.dr;
  const mpm::StencilContext context{grid, grid.origin_x, half_x, half_r};
  constexpr int width = static_cast<int>(math::pack_width);
  const int packs = static_cast<int>(std::lround(length / grid.dx)) / width;
  RelativeError value, slope;
  for (int k = 0; k < particles / width; ++k) {
    const double begin = grid.dx * (width * (k % packs) + even_share(k / packs));
    const double r = half_r + (radius - 2.0 * half_r) * even_share(7 * k + 3);
    Pack x(0.0);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane)
      x.set(lane, begin + grid.dx * static_cast<double>(lane));
    const mpm::GridToParticle read =
        mpm::grid_to_particle(grid, mpm::stencil_of(context, x, Pack(r)), Pack(0.0) <= Pack(0.0));
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      value.add(read.velocity_x[lane], field.value(x[lane], r));
      slope.add(read.rate_xx[lane], field.slope(x[lane], r));
    }
  }
  return {value.value(), slope.value()};
}

ErrorSeries grid_series(const char* quantity, const char* reference, const char* theory, double order,
                        double round_off, const Field& field, double ReadError::*error) {
  const auto settings = settings_for({10e-3, 5e-3, 2.5e-3, 1.25e-3}, [=](double cell) {
    return with_cell(cell, [=, grid = grid_with(field, cell)] { return read_error(field, grid).*error; });
  });
  return {"shape functions", quantity, "4096 particles read the grid", reference, "", theory, order,
          round_off,         settings};
}

std::vector<Setting> wave_settings(double WaveError::*error) {
  return settings_for({25, 50, 100, 200, 400}, [error](int cells) {
    return with_cell(1.0 / cells,
                     [=] { return longitudinal_error(scene::Formulation::total_lagrangian, cells).*error; });
  });
}

std::vector<Setting> conduction_by_step() {  // the cell leaves an error of 3e-5
  return settings_for({5, 10, 20, 40, 80}, [](int steps) {
    return with_steps(half_space_duration, steps, [=] { return half_space_error(0.25e-6, steps); });
  });
}

/// With the square of the spacing the first-order error of the step falls as that of the spacing.
std::vector<Setting> conduction_by_cell() {
  return settings_for({1, 2, 4, 8}, [](int division) {
    const double cell = 8e-6 / division;
    return with_cell(cell, [=] { return half_space_error(cell, 20 * division * division); });
  });
}

}  // namespace

std::vector<ErrorSeries> mechanics_series() {
  const std::string strip = "1 ms of two strips of 0.1 mm",
                    half_space = "erfc of the half space, relative L2";
  const char* const pulse = "a pulse over 0.9 m of a strip";
  const char* const leapfrog = "uGIMP on smooth fields and the leapfrog are of second order";
  const char* const reproduced = "exact at any mesh: linear fields are reproduced";
  const char* const sine = "the sine, root mean square";
  return {
      {"conduction", "temperature, by step", strip + " in cells of 0.25 um", half_space, "",
       "backward Euler is of first order", 1.0, 1e-12, conduction_by_step()},
      {"conduction", "temperature, by cell", strip + ", the step going with the square of the cell",
       half_space, "", "finite volumes are of second order", 2.0, 1e-12, conduction_by_cell()},
      {"bar wave", "velocity", pulse, "d'Alembert, relative L2", "", leapfrog, 2.0, 1e-12,
       wave_settings(&WaveError::velocity)},
      {"bar wave", "stress", pulse, "d'Alembert, relative L2", "", leapfrog, 2.0, 1e-12,
       wave_settings(&WaveError::stress)},
      grid_series("value of a linear field", "the field", reproduced, exact_order, 1e-13, linear,
                  &ReadError::value),
      grid_series("slope of a linear field", "the field", reproduced, exact_order, 1e-12, linear,
                  &ReadError::slope),
      grid_series("value of a sine of 0.16 m", sine, "linear interpolation is of second order", 2.0, 1e-13,
                  wave, &ReadError::value),
      grid_series("slope of a sine of 0.16 m", sine, "the slope of a linear interpolation is of first order",
                  1.0, 1e-12, wave, &ReadError::slope)};
}

}  // namespace launchsafe::error_of_parts
