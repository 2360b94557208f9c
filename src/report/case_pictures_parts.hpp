// The kinds of pictures of one case, each with what it needs and what it draws.
#pragma once

#include "launchsafe/report/case_pictures.hpp"

#include <functional>
#include <string>
#include <vector>

namespace launchsafe::report::detail {

std::string lacks_pressure(const DrawnCase& drawn);
std::vector<CasePicture> pressure_pictures(const DrawnCase& drawn);
std::vector<CaseTable> pressure_tables(const DrawnCase& drawn);
std::string lacks_energy(const DrawnCase& drawn);
std::vector<CasePicture> energy_pictures(const DrawnCase& drawn);

std::string lacks_fields(const DrawnCase& drawn);
std::vector<CasePicture> field_pictures(const DrawnCase& drawn);
std::vector<CaseTable> field_tables(const DrawnCase& drawn);

std::string lacks_skins(const DrawnCase& drawn);
std::vector<CasePicture> history_pictures(const DrawnCase& drawn);
std::vector<CaseTable> history_tables(const DrawnCase& drawn);
std::vector<CasePicture> profile_pictures(const DrawnCase& drawn);
std::string lacks_air(const DrawnCase& drawn);
std::vector<CasePicture> air_pictures(const DrawnCase& drawn);
std::string lacks_combustion(const DrawnCase& drawn);
std::vector<CasePicture> combustion_pictures(const DrawnCase& drawn);

/// "0.04 cm", and the same in the name of a file: "0.04cm".
std::string gap_text(double gap);
std::string gap_in_name(double gap);

/// A text of at most `longest` bytes, about, with dots in the place of the rest.
std::string shortened(const std::string& text, std::size_t longest);
/// A plot with a title of its own above that of the scene.
Plot titled_plot(const DrawnCase& drawn, std::string title);

/// Times in ms.
std::vector<double> milliseconds_of(const std::vector<double>& seconds);
PlotAxis time_axis();

/// A value for every station that tiles the bottom, against `x`: the first, the middle and the last station
/// and the one of index `marked` by name, all others thin and grey.
std::vector<Series> station_series(const trace::BottomTrace& trace, const std::vector<double>& x,
                                   const std::function<double(std::size_t, std::size_t)>& value,
                                   std::size_t marked);
/// Indices of these stations, from the axis to the wall.
std::vector<std::size_t> rings_of(const trace::BottomTrace& trace);

}  // namespace launchsafe::report::detail
