// The kinds of pictures of one case, and what their pictures have in common.
#pragma once

#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/quantities.hpp"

namespace launchsafe::report::detail {

extern const PictureKind fields_kind, histories_kind, profile_kind, combustion_kind;

/// Of a gap in the name of a file: "0.04cm".
std::string gap_in_name(double gap);

/// A plot with a title of its own above that of the scene.
Plot titled_plot(const DrawnCase& drawn, std::string title);
/// Likewise, of a quantity against time.
Plot time_plot(const DrawnCase& drawn, std::string title, std::string quantity);
/// Pressures of chamber and charge's bottom against time.
Plot load_plot(const DrawnCase& drawn);
/// Values of a quantity against times, all in SI.
Series time_series(std::string label, const std::vector<double>& time, const std::vector<double>& values,
                   const Column& quantity);

/// Values in SI in the unit of a quantity.
std::vector<double> shown_values(const std::vector<double>& values, const Column& quantity);
/// The axis of time.
Column drawn_time();

/// A row for every sample of a history.
Table sample_table(const Quantities<std::size_t>& quantities, std::size_t samples);
inline auto at_sample(const std::vector<double>& values) {
  return [&values](std::size_t sample) { return values[sample]; };
}

/// Whether the skin of a gap was computed at all stations that tile the charge's bottom.
bool has_skin(const DrawnCase& drawn, const run::GapResult& gap);
/// Indices of these stations, from the axis to the wall.
std::vector<std::size_t> annuli_of(const trace::BottomTrace& trace);

}  // namespace launchsafe::report::detail
