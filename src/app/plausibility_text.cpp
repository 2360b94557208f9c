#include "plausibility_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace launchsafe::app {
namespace {

std::string line_of(const scene::Implausible& value) {
  if (value.accepted()) return scene::accepted_text({value});
  return "verdicts are in doubt: " + scene::doubt_text(value);
}

}  // namespace

std::vector<std::string> plausibility_lines(const scene::Scene& scene) {
  std::vector<std::string> lines;
  for (const scene::Implausible& each : scene::implausible_values(scene)) lines.push_back(line_of(each));
  for (const std::string& key : scene::needless_acceptances(scene))
    lines.push_back(fmt::format("accept names {}, whose value is plausible", key));
  return lines;
}

std::vector<std::string> plausibility_lines(const study::StudyFile& study) {
  if (study.study.kind == study::StudyKind::stability) return {};
  std::vector<std::string> lines;
  for (const scene::Implausible& each : study.study.implausible) lines.push_back(line_of(each));
  std::vector<std::string> order;
  std::map<std::string, std::size_t> cases;
  for (const study::StudyCase& each : study.cases) {
    for (const scene::Implausible& value : scene::implausible_values(each.scene.scene)) {
      const std::string line = line_of(value);
      if (++cases[line] == 1) order.push_back(line);
    }
  }
  // A sensitivity study may have another value in every case.
  constexpr std::size_t most_lines = 20;
  for (std::size_t i = 0; i < std::min(order.size(), most_lines); ++i)
    lines.push_back(fmt::format("{} ({} of {} cases)", order[i], cases[order[i]], study.cases.size()));
  if (order.size() > most_lines)
    lines.push_back(fmt::format("and {} other values like these", order.size() - most_lines));
  return lines;
}

nlohmann::ordered_json plausibility_json(const scene::Scene& scene) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scene::Implausible& each : scene::implausible_values(scene)) {
    list.push_back({{"key", each.key},
                    {"value", each.value},
                    {"plausible", each.range},
                    {"accepted_because", each.accepted() ? nlohmann::ordered_json(each.because) : nullptr}});
  }
  return list;
}

}  // namespace launchsafe::app
