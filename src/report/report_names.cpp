#include "launchsafe/report/report_names.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace launchsafe::report {
namespace {

/// A name, or its beginning and end where what is between depends on the study.
struct Form {
  std::string_view begin, end = {};
  bool fits(std::string_view name) const {
    if (end.empty()) return name == begin;
    return name.size() >= begin.size() + end.size() && name.starts_with(begin) && name.ends_with(end);
  }
};

bool fits_any(std::initializer_list<Form> forms, std::string_view name) {
  return std::any_of(forms.begin(), forms.end(), [name](const Form& form) { return form.fits(name); });
}

}  // namespace

bool may_write(study::StudyKind kind, std::string_view name) {
  if (fits_any({{"report.md"}, {"study.json"}}, name)) return true;
  switch (kind) {
    case study::StudyKind::critical_gap:
      return fits_any(
          {{"verdicts.csv"}, {"verdicts.md"}, {"temperature.svg"}, {"case_", ".h5"}, {"case_", ".xdmf"}},
          name);
    case study::StudyKind::calibration:
      return fits_any({{"calibration.json"},
                       {"calibration.csv"},
                       {"hold_outs.csv"},
                       {"case_", ".h5"},
                       {"case_", ".xdmf"}},
                      name);
    case study::StudyKind::sweep:
      return fits_any({{"verdicts.csv"},
                       {"critical_gaps.json"},
                       {"critical_gaps.csv"},
                       {"critical_gaps.md"},
                       {"critical_gap", ".svg"},
                       {"safe_gap", ".svg"}},
                      name);
    case study::StudyKind::sensitivity:
      return fits_any({{"sensitivity.csv"}, {"evaluations.csv"}, {"sensitivity_", ".svg"}}, name);
    case study::StudyKind::accuracy:
      return fits_any({{"accuracy.json"},
                       {"accuracy.csv"},
                       {"reference.csv"},
                       {"points.csv"},
                       {"times.csv"},
                       {"error_against_time.svg"},
                       {"summary.md"}},
                      name);
    case study::StudyKind::stability:
      break;
  }
  return fits_any({{"stability.csv"}, {"launches.csv"}}, name);
}

bool may_write(std::string_view name) {
  using study::StudyKind;
  constexpr std::array kinds{StudyKind::critical_gap, StudyKind::calibration, StudyKind::sweep,
                             StudyKind::sensitivity,  StudyKind::accuracy,    StudyKind::stability};
  return std::any_of(kinds.begin(), kinds.end(), [name](StudyKind kind) { return may_write(kind, name); });
}

}  // namespace launchsafe::report
