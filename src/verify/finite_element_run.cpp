#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/verify/finite_elements.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

namespace launchsafe::verify {
namespace {

constexpr const char *program = "ccx", *job = "job";

/// CalculiX expands axisymmetric elements to a wedge of 2 degrees, half on each side of the plane, and prints
/// its points on both sides.
constexpr double wedge = 2.0 * std::numbers::pi / 180.0;
constexpr int printed_points = 2 * integration_points;

/// A temporary folder, removed with its content at the end of its life.
class WorkFolder {
 public:
  WorkFolder() {
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "launchsafe-XXXXXX").string();
    if (!error && ::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code error;
    if (!path_.empty()) std::filesystem::remove_all(path_, error);
  }
  const std::filesystem::path& path() const { return path_; }  ///< empty: it could not be made

 private:
  std::filesystem::path path_;
};

store::Error corrupt(const std::string& what) {
  return {store::Error::Kind::corrupt, "the output of ccx " + what};
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

/// The printed components are those of the plane's axes; the point stands beside it, at the Gauss place of
/// the half wedge. Turned about the axis of symmetry back to the radial direction of the point.
CauchyStress in_own_plane(double rr, double xx, double tt, double rx, double rt) {
  const double tangent = std::tan(0.5 * wedge) / std::sqrt(3.0);
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
  return {cosine * cosine * rr + sine * sine * tt + 2.0 * sine * cosine * rt, xx,
          sine * sine * rr + cosine * cosine * tt - 2.0 * sine * cosine * rt, rx / cosine};
}

/// The table of stresses that follows its heading; none where it is not whole. The last four points of an
/// element mirror the first.
std::optional<std::vector<CauchyStress>> read_stresses(std::string_view& text, int elements) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<CauchyStress> stresses(static_cast<std::size_t>(elements * integration_points),
                                     {nothing, nothing, nothing, nothing});
  next_line(text);  // an empty one
  std::size_t found = 0;
  for (std::string_view line = next_line(text); !line.empty(); line = next_line(text)) {
    std::istringstream numbers{std::string(line)};
    int element = 0, point = 0;
    double rr = 0, xx = 0, tt = 0, rx = 0, rt = 0, xt = 0;  // MPa
    if (!(numbers >> element >> point >> rr >> xx >> tt >> rx >> rt >> xt)) return std::nullopt;
    if (element < 1 || element > elements || point < 1 || point > printed_points) return std::nullopt;
    if (point > integration_points) continue;
    // Points 1 to 4 lie at negative angles: the turn has the other sign.
    stresses[static_cast<std::size_t>((element - 1) * integration_points + point - 1)] =
        in_own_plane(rr * deck_stress_unit, xx * deck_stress_unit, tt * deck_stress_unit,
                     rx * deck_stress_unit, -(rt * deck_stress_unit));
    ++found;
  }
  if (found != stresses.size()) return std::nullopt;
  return stresses;
}

/// The last lines of a text that say something.
std::string end_of(const std::string& text) {
  std::string end;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view line = next_line(rest);
    if (line.find("*ERROR") != std::string_view::npos) return std::string(line);
    if (line.find_first_not_of(" _\r") != std::string_view::npos) end = line;
  }
  return end;
}

}  // namespace

StressMeasures CauchyStress::measures() const {
  const double mean = (rr + xx + tt) / 3.0;
  const double a = rr - mean, b = xx - mean, c = tt - mean;
  return {-mean, std::sqrt(1.5 * (a * a + b * b + c * c + 2.0 * rx * rx))};
}

store::Result<FiniteElementResult> read_finite_element_output(std::string_view text, int elements) {
  std::optional<FiniteElementResult> last;
  while (!text.empty()) {
    if (next_line(text).find(" stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz)") != 0) continue;
    auto stresses = read_stresses(text, elements);
    if (!stresses) return corrupt(fmt::format("has no whole table of the stresses in {} elements", elements));
    last = FiniteElementResult{std::move(*stresses)};
  }
  if (!last) return corrupt("has no table of stresses");
  return std::move(*last);
}

store::Result<std::string> finite_element_version() {
  const auto run = store::run_program(program, {"-v"}, "");
  if (!run) return run.error();
  const std::string known = "This is Version ";
  const std::size_t begin = run->output.find(known);
  if (begin == std::string::npos)
    return store::Error{store::Error::Kind::failed, "ccx does not say its version: " + end_of(run->output)};
  const std::size_t number = begin + known.size();
  return run->output.substr(number, run->output.find_first_of(" \r\n", number) - number);
}

store::Result<FiniteElementResult> run_finite_elements(const FiniteElementModel& model,
                                                       const store::ProgramLimits& limits) {
  const WorkFolder folder;
  const std::filesystem::path base = folder.path() / job;
  if (folder.path().empty() ||
      store::write_file_atomically(base.string() + ".inp", {deck_of(model)}, store::IfExists::replace))
    return store::Error{store::Error::Kind::write_failed,
                        "cannot write the input of ccx to a temporary folder"};
  const auto run = store::run_program(program, {"-i", job}, "", limits, folder.path());
  if (!run) return run.error();
  // Its exit code is 0 after most failures too.
  if (!run->succeeded || run->output.find("Job finished") == std::string::npos)
    return store::Error{store::Error::Kind::failed,
                        "ccx did not finish: " + end_of(run->output + "\n" + run->errors)};
  const auto printed = store::read_file(base.string() + ".dat");
  if (!printed) return printed.error();
  return read_finite_element_output(*printed, model.elements());
}

}  // namespace launchsafe::verify
