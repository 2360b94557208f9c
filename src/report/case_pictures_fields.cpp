// Fields over the section of a shell, from the snapshots of a case.
#include "case_pictures_parts.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::report::detail {
namespace {

constexpr double millimetres = 1e3;  // per m, of the drawing

using Field = run::SnapshotField;

bool is_charge(const DrawnCase& drawn, int body) {
  return scene::is_charge(drawn.scene, drawn.scene.bodies[static_cast<std::size_t>(body)]);
}

/// Six digits of a field, in the unit in which people read it.
keys::Form form_of(const Field& field) { return keys::significant(6, field.shown); }

double value_of(const DrawnCase& drawn, const Field& field, const run::Snapshot& shot, std::size_t i) {
  if (!has_field(drawn.scene, drawn.scene.bodies[static_cast<std::size_t>(shot.body[i])], field))
    return std::numeric_limits<double>::quiet_NaN();
  const std::vector<double>& values = values_of(shot, field);
  return values.empty() ? 0.0 : shown_value(values[i], form_of(field));
}

/// The bodies whose values share colours: stresses of a shell are many times those of its charge.
struct ScaleGroup {
  const char* name;
  bool charges;
};
std::vector<ScaleGroup> scale_groups(const DrawnCase& drawn, const Field& field) {
  std::vector<ScaleGroup> groups;
  for (const ScaleGroup& group : {ScaleGroup{"charge", true}, ScaleGroup{"shell", false}}) {
    const bool has_it = std::ranges::any_of(drawn.scene.bodies, [&](const scene::Body& body) {
      return scene::is_charge(drawn.scene, body) == group.charges && has_field(drawn.scene, body, field);
    });
    if (has_it) groups.push_back(group);
  }
  return groups;
}

/// Values with the lengths of their cells.
using Lengths = std::vector<std::pair<double, double>>;

/// Where 98 % of the length is that has not 0, as most has of what burns. By number, small cells at a corner
/// would leave one colour for all others; by area, the bottom would be beyond.
std::pair<double, double> common_range(Lengths lengths) {
  if (lengths.empty()) return {0.0, 0.0};
  std::ranges::sort(lengths);
  double whole = 0.0;
  for (const auto& [value, length] : lengths) whole += value == 0.0 ? 0.0 : length;
  const auto first_within = [cut = 0.01 * whole](auto begin, auto end) {
    double sum = 0.0;
    return std::find_if(begin, end, [&](const auto& each) { return (sum += each.second) > cut; })->first;
  };
  const double low = first_within(lengths.begin(), lengths.end()),
               high = first_within(lengths.rbegin(), lengths.rend());
  return low < high ? std::pair(low, high) : std::pair(lengths.front().first, lengths.back().first);
}

/// Of one snapshot: what others have, before or while it burns, would leave one colour for it.
std::vector<ColourScale> scales_of(const DrawnCase& drawn, const Field& field, const run::Snapshot& shot) {
  std::vector<ColourScale> scales;
  for (const ScaleGroup& group : scale_groups(drawn, field)) {
    Lengths lengths;
    for (std::size_t i = 0; i < shot.x.size(); ++i) {
      const double value = value_of(drawn, field, shot, i);
      if (std::isfinite(value) && is_charge(drawn, shot.body[i]) == group.charges)
        lengths.emplace_back(value, std::sqrt(shot.half_length_x[i] * shot.half_length_r[i]));
    }
    const auto [minimum, maximum] = common_range(std::move(lengths));
    scales.push_back({fmt::format("{}: {} [{}]", group.name, field.meaning,
                                  field.shown.name.empty() ? "1" : field.shown.name),
                      minimum, maximum});
  }
  return scales;
}

// --- outlines ---

/// The particles of one body in a snapshot: rows along x, from the axis outward.
struct BodyCells {
  const scene::Body* body;
  std::size_t first, columns, rows;
  std::size_t end() const { return first + columns * rows; }
};

std::vector<BodyCells> bodies_of(const scene::Scene& scene) {
  std::vector<BodyCells> bodies;
  for (const scene::Body& body : scene.bodies) {
    const scene::ParticleCount count = scene::particles_of(scene, body);
    bodies.push_back({&body, bodies.empty() ? 0 : bodies.back().end(), static_cast<std::size_t>(count.nx),
                      static_cast<std::size_t>(count.nr)});
  }
  return bodies;
}

/// Along the row next to the axis, the end at the base, the outermost row, and the end at the nose.
std::vector<Place> edge_of(const run::Snapshot& shot, const BodyCells& cells, bool open_at_axis) {
  std::vector<Place> path;
  const auto add = [&](std::size_t i, std::size_t j, double towards_base, double outward) {
    const std::size_t k = cells.first + j * cells.columns + i;
    path.push_back({millimetres * (shot.x[k] + towards_base * shot.half_length_x[k]),
                    millimetres * (shot.r[k] + outward * shot.half_length_r[k])});
  };
  const std::size_t last = cells.columns - 1, top = cells.rows - 1;
  for (std::size_t i = 0; !open_at_axis && i <= last; ++i)
    for (const double side : {-1.0, 1.0}) add(i, 0, side, -1.0);
  for (std::size_t j = 0; j <= top; ++j)
    for (const double side : {-1.0, 1.0}) add(last, j, 1.0, side);
  for (std::size_t i = last + 1; i-- > 0;)
    for (const double side : {1.0, -1.0}) add(i, top, side, 1.0);
  for (std::size_t j = top + 1; j-- > 0;)
    for (const double side : {1.0, -1.0}) add(0, j, -1.0, side);
  return path;
}

// --- pictures ---

/// Around the charge's bottom, of a shell so slender that its cells there are hard to see; of a field that is
/// 0 nearly everywhere, as far from the axis as it is not.
std::optional<Enlargement> enlargement_of(const DrawnCase& drawn, const Field& field,
                                          const run::Snapshot& shot) {
  constexpr double slender = 1.5, length_over_radius = 2.4, share_before_bottom = 0.62, margin = 1.2;
  double begin = HUGE_VAL, end = -HUGE_VAL, radius = 0, bottom = -HUGE_VAL, reach = 0;
  for (std::size_t i = 0; i < shot.x.size(); ++i) {
    const double right = shot.x[i] + shot.half_length_x[i];
    begin = std::min(begin, shot.x[i] - shot.half_length_x[i]);
    end = std::max(end, right);
    radius = std::max(radius, shot.r[i] + shot.half_length_r[i]);
    if (is_charge(drawn, shot.body[i])) bottom = std::max(bottom, right);
    const double value = value_of(drawn, field, shot, i);
    if (std::isfinite(value) && value != 0.0)
      reach = std::max(reach, margin * (shot.r[i] + shot.half_length_r[i]));
  }
  radius = std::min(radius, reach);
  const double length = length_over_radius * radius;
  if (!std::isfinite(bottom) || !(length > 0.0) || end - begin < slender * length) return {};
  const double from = std::clamp(bottom - share_before_bottom * length, begin, end - length);
  return Enlargement{"At the bottom of the charge", millimetres * from, millimetres * (from + length),
                     millimetres * radius};
}

std::vector<FieldCell> cells_of(const DrawnCase& drawn, const Field& field, const run::Snapshot& shot) {
  std::vector<FieldCell> cells;
  cells.reserve(shot.x.size());
  const bool charges_first = scale_groups(drawn, field).front().charges;
  for (std::size_t i = 0; i < shot.x.size(); ++i)
    cells.push_back({millimetres * shot.x[i], millimetres * shot.r[i], millimetres * shot.half_length_x[i],
                     millimetres * shot.half_length_r[i], value_of(drawn, field, shot, i),
                     charges_first && !is_charge(drawn, shot.body[i]) ? std::size_t{1} : 0});
  // Half lengths are those of a cell between its neighbours: beside one that has burnt there would be a slit.
  // Neighbours in a row share an edge half way between their own.
  for (const BodyCells& body : bodies_of(drawn.scene))
    for (std::size_t i = body.first + 1; i < body.end(); ++i) {
      if ((i - body.first) % body.columns == 0) continue;
      const double begin = cells[i].x - cells[i].half_x, behind = cells[i].x + cells[i].half_x;
      const double before = cells[i - 1].x - cells[i - 1].half_x;
      const double edge = 0.5 * (cells[i - 1].x + cells[i - 1].half_x + begin);
      cells[i - 1].x = 0.5 * (before + edge);
      cells[i - 1].half_x = 0.5 * (edge - before);
      cells[i].x = 0.5 * (edge + behind);
      cells[i].half_x = 0.5 * (behind - edge);
    }
  return cells;
}

/// The words of a snapshot's events with something between.
std::string events_of(const run::Snapshot& shot, const char* between) {
  std::vector<std::string> words;
  for (const scene::Event event : shot.events) words.push_back(scene::word_of(event));
  return fmt::format("{}", fmt::join(words, between));
}

/// "_0.04cm_18ms_burnt": of a gap that burns, at a time that was asked for, at an event.
std::string name_of(const ShownSnapshot& shown) {
  std::string name;
  if (shown.gap) name += "_" + gap_in_name(*shown.gap);
  if (shown.asked_for || shown.snapshot->events.empty())
    name += fmt::format("_{}ms", digits_of(shown.time(), keys::significant(6, millisecond)));
  if (!shown.snapshot->events.empty()) name += "_" + events_of(*shown.snapshot, "_");
  return name;
}

/// In a picture of temperatures before anything burns, the largest gap whose skin is known then and does not
/// burn yet.
const run::GapResult* skin_in(const DrawnCase& drawn, const Field& field, const ShownSnapshot& shown) {
  const double time = shown.snapshot->time;
  const run::GapResult* largest = nullptr;
  if (field.values != &run::Snapshot::temperature || shown.gap) return largest;
  for (const run::GapResult& gap : drawn.result.gaps)
    if (has_skin(drawn, gap) && !(gap.skin.ignition && gap.skin.ignition->time <= time) &&
        (largest == nullptr || gap.gap > largest->gap))
      largest = &gap;
  return largest;
}

/// Adds the skin under a gap, drawn deeper than it is, in colours from the coldest cell to the hottest
/// station: the bulk hardly warms.
void add_skin(const DrawnCase& drawn, const run::Snapshot& shot, const run::GapResult& gap, CellPlot& plot) {
  constexpr double share_of_radius = 0.06;
  const trace::BottomTrace& trace = drawn.result.mechanics.trace;
  const double width = drawn.scene.surface.station_width, thickness = drawn.scene.surface.skin_thickness;
  double bottom = -HUGE_VAL, radius = 0;
  ColourScale scale{"temperature [K]", HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i < shot.x.size(); ++i) {
    if (is_charge(drawn, shot.body[i])) bottom = std::max(bottom, shot.x[i] + shot.half_length_x[i]);
    radius = std::max(radius, shot.r[i]);
    plot.cells[i].scale = 0;
    scale.minimum = std::min(scale.minimum, plot.cells[i].value);
    scale.maximum = std::max(scale.maximum, plot.cells[i].value);
  }
  const double bulk = scale.maximum, half_depth = 0.5 * share_of_radius * radius;
  double hottest_r = 0.0;
  for (const std::size_t ring : rings_of(trace)) {
    const double temperature = surface::temperature_at_time(gap.skin, trace, ring, shot.time);
    plot.cells.push_back({millimetres * (bottom - half_depth), millimetres * trace.stations[ring].r,
                          millimetres * half_depth, millimetres * 0.5 * width, temperature});
    if (temperature > scale.maximum) hottest_r = trace.stations[ring].r;
    scale.maximum = std::max(scale.maximum, temperature);
  }
  plot.scales = {scale};
  plot.title = fmt::format(
      "Gap {} at {}: the skin has up to {}, at r {}, all behind it at most {}", centimetres(gap.gap),
      in_words(shot.time, quantity::time_in_titles), in_words(scale.maximum, keys::fixed(0, kelvin)),
      in_words(hottest_r, keys::significant(3, millimetre)), in_words(bulk, keys::fixed(0, kelvin)));
  plot.subtitle += fmt::format("; the skin, {} deep, is drawn {} times as deep",
                               in_words(thickness, keys::significant(2, millimetre)),
                               significant(2.0 * half_depth / thickness, 2));
}

/// Where it is highest, in the charge or in the bodies that have the field.
std::string finding_of(const CellPlot& plot, const Field& field, const char* bodies) {
  const auto value = [](const FieldCell& cell) {
    return cell.scale == 0 && std::isfinite(cell.value) ? cell.value : -HUGE_VAL;
  };
  const FieldCell& highest = *std::ranges::max_element(plot.cells, {}, value);
  return fmt::format("highest in the {} at x {}, r {} mm, {}{}{}", bodies, significant(highest.x, 3),
                     significant(highest.r, 3),
                     significant(highest.value, std::abs(highest.value) < 100.0 ? 2 : 4),
                     field.shown.name.empty() ? "" : " ", field.shown.name);
}

CellPlot field_plot(const DrawnCase& drawn, const Field& field, const ShownSnapshot& shown,
                    const std::vector<ColourScale>& scales) {
  const run::Snapshot& shot = *shown.snapshot;
  CellPlot plot;
  plot.title = fmt::format("{} at {}", field.title.empty() ? field.meaning : field.title,
                           in_words(shot.time, quantity::time_in_titles));
  if (!shot.events.empty()) plot.title += ", " + events_of(shot, ", ");
  const bool closes = drawn.scene.surface.model == scene::GapModel::closing;
  plot.title += shown.gap                   ? fmt::format(", gap of {} burning", centimetres(*shown.gap))
                : drawn.result.gaps.empty() ? ""
                : closes                    ? ", without a gap"
                                            : ", without burning";
  plot.title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title[0])));
  plot.subtitle = shortened(drawn.scene.title, 150);
  plot.scales = scales;
  plot.cells = cells_of(drawn, field, shot);
  plot.title += ": " + finding_of(plot, field, scale_groups(drawn, field).front().name);
  for (const BodyCells& cells : bodies_of(drawn.scene)) {
    const bool open_at_axis = cells.body->r_begin <= scene::length_tolerance(drawn.scene);
    plot.outlines.push_back({edge_of(shot, cells, open_at_axis), open_at_axis});
  }
  plot.enlargement = enlargement_of(drawn, field, shot);
  const bool grey =
      std::ranges::any_of(plot.cells, [](const FieldCell& cell) { return std::isnan(cell.value); });
  const auto groups = scale_groups(drawn, field);
  if (const run::GapResult* skin = skin_in(drawn, field, shown)) add_skin(drawn, shot, *skin, plot);
  if (grey) plot.without_value = groups.size() == 1 && groups[0].charges ? "not a charge" : "without it";
  return plot;
}

/// Whether it is one that a picture tells something of: all colours of what varies by less mean the same.
bool varies(const std::vector<ColourScale>& scales) {
  constexpr double least = 0.01;
  return std::ranges::any_of(scales, [](const ColourScale& scale) {
    return scale.maximum - scale.minimum > least * std::max(std::abs(scale.minimum), std::abs(scale.maximum));
  });
}

/// The snapshots that were asked for, all without times.
std::vector<ShownSnapshot> chosen_snapshots(const DrawnCase& drawn) {
  std::vector<ShownSnapshot> chosen;
  for (const ShownSnapshot& each : shown_snapshots(drawn)) {
    const bool wanted = std::ranges::any_of(drawn.times, [&](double time) { return is_of_time(each, time); });
    if (drawn.times.empty() || wanted) chosen.push_back(each);
  }
  return chosen;
}

/// Whether the particles of a snapshot are those that the scene's grid makes, body after body.
bool fits(const scene::Scene& scene, const run::Snapshot& shot) {
  std::vector<int> bodies;
  for (const BodyCells& each : bodies_of(scene)) {
    if (each.end() > shot.body.size()) return false;
    bodies.resize(each.end(), static_cast<int>(each.body - scene.bodies.data()));
  }
  return bodies == shot.body;
}

std::string lacks_fields(const DrawnCase& drawn) {
  const auto snapshots = shown_snapshots(drawn);
  if (snapshots.empty()) return "it has no snapshots; output.snapshots of the scene asks for them";
  for (const ShownSnapshot& each : snapshots) {
    const run::Snapshot& shot = *each.snapshot;
    if (!fits(drawn.scene, shot)) return "its snapshots do not fit the grid of its scene";
    const auto is_length = [](double length) { return length > 0.0; };
    for (const auto* lengths : {&shot.half_length_x, &shot.half_length_r})
      if (!std::ranges::all_of(*lengths, is_length)) return "a cell in its snapshots is inverted";
  }
  return {};
}

std::vector<CasePicture> field_pictures(const DrawnCase& drawn) {
  std::vector<CasePicture> pictures;
  for (const Field& field : run::snapshot_fields()) {
    if (!field.drawn || scale_groups(drawn, field).empty()) continue;
    for (const ShownSnapshot& each : chosen_snapshots(drawn)) {
      const std::vector<ColourScale> scales = scales_of(drawn, field, *each.snapshot);
      if (varies(scales) || skin_in(drawn, field, each) != nullptr)
        pictures.push_back({fmt::format("field_{}{}.svg", field.name, name_of(each)),
                            field_plot(drawn, field, each, scales), each.snapshot->time, each.gap});
    }
  }
  return pictures;
}

Quantities<std::size_t> particle_quantities(const DrawnCase& drawn, const run::Snapshot& shot) {
  Quantities<std::size_t> quantities{
      {"body", "body", keys::text(), "Body of the particle.",
       [&](std::size_t i) { return drawn.scene.bodies[static_cast<std::size_t>(shot.body[i])].name; }},
      {"x", "x", keys::significant(6, millimetre), "Of the particle at present.", at_sample(shot.x)},
      {"r", "r", keys::significant(6, millimetre), "Likewise.", at_sample(shot.r)}};
  for (const Field& field : run::snapshot_fields()) {
    const std::string name(field.name), meaning(field.meaning);
    const std::vector<double>& all = values_of(shot, field);
    quantities.push_back({{name, name, form_of(field), meaning}, [&all](std::size_t i) {
                            return all.empty() ? std::nullopt : std::optional(all[i]);
                          }});
  }
  return quantities;
}

std::vector<CaseTable> field_tables(const DrawnCase& drawn) {
  std::vector<CaseTable> tables;
  for (const ShownSnapshot& each : chosen_snapshots(drawn))
    tables.push_back({"field" + name_of(each) + ".csv",
                      sample_table(particle_quantities(drawn, *each.snapshot), each.snapshot->x.size())});
  return tables;
}

}  // namespace

const PictureKind fields_kind{"fields",
                              "pressure, von Mises stress, crack radius, burnt share and temperature with "
                              "the skin's at every snapshot, where they vary by 1 % at least",
                              lacks_fields, field_pictures, field_tables};

}  // namespace launchsafe::report::detail
