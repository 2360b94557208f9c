// Where constants hold: the intervals of their launch, and what their fit leaves open.
#include "launchsafe/math/numbers.hpp"
#include "launchsafe/scene/constants.hpp"
#include "scene_file.hpp"

#include <Eigen/LU>

namespace launchsafe::scene {
namespace {

constexpr double round_off = 1e-9;

/// The number of an interval in a scene, SI.
double number_of(const std::string& name, const Scene& scene) {
  const Extent all = extent_of(scene), charge = charge_extent(scene);
  if (name == "peak_pressure") return PressureHistory(scene.load).stated_peak();
  if (name == "initial_temperature") return scene.initial_temperature;
  if (name == "calibre") return 2.0 * all.r_end;
  if (name == "charge_length") return charge.x_end - charge.x_begin;
  if (name == "wall_thickness") return all.r_end - charge.r_end;
  if (name == "crack_radius") return scene.charge().strength.initial_crack_radius;
  return scene.charge().strength.flaw_size;
}

std::optional<OutsideOfRange> outside_of_interval(const RangeKey& key, const std::string& interval,
                                                  const Scene& scene) {
  const double number = number_of(key.name, scene);
  const std::vector<double> ends = parse_range(interval, key.dimension);
  const double slack = round_off * std::abs(number);
  if (number >= ends[0] - slack && number <= ends[1] + slack) return std::nullopt;
  return OutsideOfRange{key.name, format_quantity(number, key.dimension), interval, key.acceptable};
}

/// The largest relative difference of two values; infinite where they are no numbers and differ.
double difference_of(const Value& own, const Value& fitted) {
  const auto relative = [](double a, double b) {
    const double larger = std::max(std::abs(a), std::abs(b));
    return larger > 0.0 ? std::abs(a - b) / larger : 0.0;
  };
  if (const auto* number = std::get_if<double>(&own)) return relative(*number, std::get<double>(fitted));
  const auto* numbers = std::get_if<std::vector<double>>(&own);
  if (numbers == nullptr) return own == fitted ? 0.0 : math::infinity;
  const auto& others = std::get<std::vector<double>>(fitted);
  double largest = numbers->size() == others.size() ? 0.0 : math::infinity;
  for (std::size_t i = 0; i < std::min(numbers->size(), others.size()); ++i)
    largest = std::max(largest, relative((*numbers)[i], others[i]));
  return largest;
}

/// The number of a material that differs most from that of the launch that was fitted.
struct MaterialDifference {
  double share = 0;
  std::string text;  ///< "steel.yield_stress = 792 MPa"
};

template <class Law>
void compare_law(const Law& own, const Law& fitted, MaterialDifference& most) {
  // They have intervals of their own.
  static const std::vector<std::string_view> elsewhere{"charge.crack_radius", "charge.flaw_size"};
  for (const Key<Law>& key : Law::parameters()) {
    if (contains(elsewhere, key.name) || (!key.is_used(own) && !key.is_used(fitted))) continue;
    double share = difference_of(key.get(own), key.get(fitted));
    // A constant itself: a material that states another one is of no launch that was fitted.
    const bool ignites = key.name == "kinetics.ignition_temperature" && share > round_off;
    if (ignites || key.is_used(own) != key.is_used(fitted)) share = math::infinity;
    if (share > most.share) most = {share, key.name + " = " + format_value(key, key.get(own))};
  }
}

/// Of all bodies that are charges, or of all others.
MaterialDifference compare_materials(const Constants& constants, const Scene& scene, bool of_charge) {
  MaterialDifference most;
  for (const Body& body : scene.bodies) {
    if (is_charge(scene, body) != of_charge) continue;
    const materials::Law& law = law_of(scene, body);
    if (const auto* steel = std::get_if<Steel>(&law))
      compare_law(*steel, constants.scene.steel(), most);
    else if (const auto* charge = std::get_if<Charge>(&law))
      compare_law(*charge, constants.scene.charge(), most);
    else
      most = {math::infinity, "body " + body.name + " of another law"};
  }
  return most;
}

std::optional<OutsideOfRange> outside_of_material(const RangeKey& key, const std::string& interval,
                                                  const Constants& constants, const Scene& scene) {
  const MaterialDifference most = compare_materials(constants, scene, key.name == "explosive");
  if (most.share <= parse_quantity(interval, key.dimension) * (1.0 + round_off)) return std::nullopt;
  return OutsideOfRange{key.name, most.text, "within " + interval, key.acceptable};
}

}  // namespace

const std::vector<RangeKey>& range_keys() {
  static const std::vector<RangeKey> keys{
      {"peak_pressure", Dimension::pressure, true, "peak of the chamber pressure"},
      {"initial_temperature", Dimension::temperature, true, "temperature before launch"},
      {"calibre", Dimension::length, true, "outer diameter of the shell"},
      {"charge_length", Dimension::length, true, "length of the charge"},
      {"wall_thickness", Dimension::length, true, "thickness of the wall around the charge"},
      {"crack_radius", Dimension::length, true, "radius of the cracks before launch"},
      {"flaw_size", Dimension::length, true, "flaw size"},
      {"steel", Dimension::share, true, "largest difference of a number of the steel"},
      {"explosive", Dimension::share, false, "largest difference of a number of the charge"},
  };
  return keys;
}

std::vector<OutsideOfRange> outside_of_range(const Constants& constants, const Scene& scene) {
  std::vector<OutsideOfRange> outside;
  for (const RangeKey& key : range_keys()) {
    const std::string* interval = find_in(constants.range, key.name);
    auto found = interval == nullptr
                     ? std::optional(OutsideOfRange{key.name, "no interval", "nowhere", key.acceptable})
                 : key.dimension == Dimension::share ? outside_of_material(key, *interval, constants, scene)
                                                     : outside_of_interval(key, *interval, scene);
    if (found) outside.push_back(std::move(*found));
  }
  return outside;
}

SkinConstants skin_constants(const Constants& constants) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  SkinConstants of_skin;
  std::vector<Eigen::Index> places;
  for (std::size_t i = 0; i < constants.fitted_keys.size(); ++i) {
    if (acts_on(constants.fitted_keys[i]) != keys::ActsOn::surface) continue;
    of_skin.keys.push_back(constants.fitted_keys[i]);
    places.push_back(static_cast<Eigen::Index>(i));
  }
  const auto size = static_cast<Eigen::Index>(constants.fitted_keys.size());
  if (places.empty()) return of_skin;
  // The inverse of the part of the inverse: all together the published rows leave far more open.
  const Matrix information = Eigen::Map<const Matrix>(constants.covariance.data(), size, size).inverse();
  const Matrix inverse = Matrix(information(places, places)).inverse();
  const Matrix conditional = 0.5 * (inverse + inverse.transpose());
  of_skin.covariance.assign(conditional.data(), conditional.data() + conditional.size());
  return of_skin;
}

double largest_temperature_misfit(const Constants& constants) {
  double largest = 0.0;
  for (const FittedNumber& row : constants.rows)
    if (row.is_fitted && row.quantity.starts_with("T at"))
      largest = std::max(largest, std::abs(row.misfit()));
  return largest;
}

}  // namespace launchsafe::scene
