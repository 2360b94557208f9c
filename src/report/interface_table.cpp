#include "launchsafe/report/interface_table.hpp"

#include "launchsafe/report/columns.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace launchsafe::report {
namespace {

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

Table interface_table(const run::MechanicsResult& mechanics) {
  Table table;
  table.title = "Faces that slide on the charge";
  table.columns = {text_column("body"),
                   text_column("face"),
                   significant_column("friction work", "J", 4, "friction_work_J"),
                   significant_column("largest heat", "kJ/m2", 3, "largest_heat_kJ_per_m2"),
                   significant_column("at", "cm", 4, "at_cm"),
                   significant_column("slid up to", "mm", 3, "slid_mm"),
                   significant_column("open up to", "mm", 3, "open_mm"),
                   number_column("bonded nodes", "%", 0, "bonded_percent")};
  for (const run::InterfaceResult& faces : mechanics.interfaces) {
    const auto hottest = std::max_element(faces.friction_heat.begin(), faces.friction_heat.end());
    if (hottest == faces.friction_heat.end()) continue;
    const auto node = static_cast<std::size_t>(hottest - faces.friction_heat.begin());
    const double bonded = std::accumulate(faces.bonded.begin(), faces.bonded.end(), 0.0);
    table.rows.push_back({faces.body, std::string(faces.along_x ? "along x" : "along r"), faces.friction_work,
                          1e-3 * *hottest, 100.0 * faces.place.at(node), 1e3 * largest(faces.slid),
                          1e3 * largest(faces.largest_gap),
                          100.0 * bonded / static_cast<double>(faces.bonded.size())});
  }
  if (!table.rows.empty())
    table.notes.push_back(
        "Heat of friction is per area of the face, over the whole launch, and heats no skin: that at the "
        "charge's bottom counts as uncertainty of T max instead.");
  return table;
}

}  // namespace launchsafe::report
