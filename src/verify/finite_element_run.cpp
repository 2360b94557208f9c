#include "launchsafe/verify/finite_element_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

namespace launchsafe::verify {
namespace {

constexpr const char *program = "ccx", *job = "job";

/// CalculiX expands axisymmetric elements to a wedge of 2 degrees, half on each side of the plane, and prints
/// its points on both sides.
constexpr double wedge = 2.0 * std::numbers::pi / 180.0;
constexpr int printed_points = 2 * integration_points;

/// A folder that goes when this does.
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

/// As many numbers as stand in a line, at most 8.
std::vector<double> numbers_in(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<double> numbers;
  for (double number; numbers.size() < 8 && stream >> number;) numbers.push_back(number);
  return numbers;
}

/// The printed components are those of the plane's axes; the point stands beside it, at the Gauss place of
/// the half wedge. Turned about the axis of symmetry back to the radial direction of the point.
CauchyStress in_own_plane(double rr, double xx, double tt, double rx, double rt) {
  const double tangent = std::tan(0.5 * wedge) / std::sqrt(3.0);
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
  return {cosine * cosine * rr + sine * sine * tt + 2.0 * sine * cosine * rt, xx,
          sine * sine * rr + cosine * cosine * tt - 2.0 * sine * cosine * rt, rx / cosine};
}

/// The table of stresses that follows its heading. The last four points of an element mirror the first.
bool read_stresses(std::string_view& text, int elements, std::vector<CauchyStress>& stress) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  stress.assign(static_cast<std::size_t>(elements * integration_points),
                {nothing, nothing, nothing, nothing});
  next_line(text);  // an empty one
  std::size_t found = 0;
  for (std::string_view line = next_line(text); !line.empty(); line = next_line(text)) {
    const std::vector<double> n = numbers_in(line);  // element, point, rr, xx, tt, rx, rt, xt
    if (n.size() != 8 || n[0] < 1 || n[0] > elements || n[1] < 1 || n[1] > printed_points) return false;
    if (n[1] > integration_points) continue;
    const auto slot = static_cast<std::size_t>((n[0] - 1) * integration_points + (n[1] - 1));
    // Points 1 to 4 lie at negative angles: the turn has the other sign.
    const auto in_pascal = [&](std::size_t k) { return n[k] * deck_stress_unit; };
    stress[slot] = in_own_plane(in_pascal(2), in_pascal(3), in_pascal(4), in_pascal(5), -in_pascal(6));
    ++found;
  }
  return found == stress.size();
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

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

StressMeasures CauchyStress::measures() const {
  const double mean = (rr + xx + tt) / 3.0;
  const double a = rr - mean, b = xx - mean, c = tt - mean;
  return {-mean, std::sqrt(1.5 * (a * a + b * b + c * c + 2.0 * rx * rx))};
}

store::Result<FiniteElementResult> read_finite_element_output(std::string_view text, int elements) {
  FiniteElementResult result;
  bool has_stress = false;
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    if (line.find(" stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz)") == 0) {
      if (!read_stresses(text, elements, result.stress))
        return corrupt(fmt::format("has no whole table of the stresses in {} elements", elements));
      has_stress = true;
    }
  }
  if (!has_stress) return corrupt("has no table of stresses");
  return result;
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
  std::ofstream deck(base.string() + ".inp", std::ios::binary);
  deck << deck_of(model) << std::flush;
  if (folder.path().empty() || !deck)
    return store::Error{store::Error::Kind::write_failed,
                        "cannot write the input of ccx to a temporary folder"};
  deck.close();
  const auto run = store::run_program(program, {"-i", job}, "", limits, folder.path());
  if (!run) return run.error();
  // Its exit code is 0 after most failures too.
  if (!run->succeeded || run->output.find("Job finished") == std::string::npos)
    return store::Error{store::Error::Kind::failed,
                        "ccx did not finish: " + end_of(run->output + "\n" + run->errors)};
  return read_finite_element_output(content_of(base.string() + ".dat"), model.elements());
}

}  // namespace launchsafe::verify
