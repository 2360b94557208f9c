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

bool is_burnt_share(const Field& field) { return field.values == &run::Snapshot::burnt_share; }

/// Nothing where the body has not got the field, and where nothing has burnt.
double value_of(const DrawnCase& drawn, const Field& field, const run::Snapshot& shot, std::size_t i) {
  const std::vector<double>& values = values_of(shot, field);
  const bool has_it =
      !values.empty() && !(is_burnt_share(field) && values[i] == 0.0) &&
      has_field(drawn.scene, drawn.scene.bodies[static_cast<std::size_t>(shot.body[i])], field);
  return has_it ? shown_value(values[i], form_of(field)) : std::numeric_limits<double>::quiet_NaN();
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

constexpr double little = 0.1;  // of a range, by which more belongs to it

/// Where 98 % of the length is, and what is little beyond. By number, small cells at a corner would leave one
/// colour for all others; by area, the bottom would be beyond.
std::pair<double, double> common_range(Lengths lengths) {
  if (lengths.empty()) return {0.0, 0.0};
  std::ranges::sort(lengths);
  double whole = 0.0;
  for (const auto& [value, length] : lengths) whole += length;
  const auto first_within = [cut = 0.01 * whole](auto begin, auto end) {
    double sum = 0.0;
    return std::find_if(begin, end, [&](const auto& each) { return (sum += each.second) > cut; })->first;
  };
  const double low = first_within(lengths.begin(), lengths.end()),
               high = first_within(lengths.rbegin(), lengths.rend()), more = little * (high - low);
  const auto value = &Lengths::value_type::first;
  return {std::ranges::lower_bound(lengths, low - more, {}, value)->first,
          std::prev(std::ranges::upper_bound(lengths, high + more, {}, value))->first};
}

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
                      is_burnt_share(field) ? 0.0 : minimum, maximum});
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

constexpr double beside = 1.2;  // of what is to be seen, so far a window reaches

/// Around the cells with a value, where few have one.
Window window_of(const std::vector<FieldCell>& cells) {
  Window window{HUGE_VAL, -HUGE_VAL, 0.0};
  for (const FieldCell& cell : cells) {
    if (std::isnan(cell.value)) continue;
    window.x_begin = std::min(window.x_begin, cell.x - cell.half_x);
    window.x_end = std::max(window.x_end, cell.x + cell.half_x);
    window.r_end = std::max(window.r_end, beside * (cell.r + cell.half_r));
  }
  const double depth = window.x_end - window.x_begin;
  window.x_begin -= depth;
  window.x_end += depth;
  return window;
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
  const auto word = [](scene::Event event) { return scene::word_of(event); };
  return fmt::format("{}", fmt::join(study::of_each(shot.events, word), between));
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
  const run::Snapshot& shot = *shown.snapshot;
  const run::GapResult* largest = nullptr;
  const bool has_bottom = shot.bottom_x.size() == 2 * annuli_of(drawn.result.mechanics.trace).size();
  if (field.values != &run::Snapshot::temperature || shown.gap || !has_bottom) return largest;
  for (const run::GapResult& gap : drawn.result.gaps)
    if (has_skin(drawn, gap) && !(gap.skin.ignition && gap.skin.ignition->time <= shot.time) &&
        (largest == nullptr || gap.gap > largest->gap))
      largest = &gap;
  return largest;
}

/// Draws the skin under a gap alone, in colours from its coldest station to its hottest: the bulk hardly
/// warms.
void draw_skin(const DrawnCase& drawn, const run::Snapshot& shot, const run::GapResult& gap, CellPlot& plot) {
  const trace::BottomTrace& trace = drawn.result.mechanics.trace;
  const double half_depth = 0.5 * drawn.scene.surface.skin_thickness;
  double bulk = -HUGE_VAL;
  for (FieldCell& cell : plot.cells) {
    bulk = std::max(bulk, cell.value);
    cell.value = std::numeric_limits<double>::quiet_NaN();
  }
  std::vector<FieldCell> skin;
  for (std::size_t station = 0; station < trace.stations.size(); ++station) {
    if (trace.stations[station].observation) continue;
    const std::size_t begin = 2 * skin.size(), end = begin + 1;
    skin.push_back({millimetres * (0.5 * (shot.bottom_x[begin] + shot.bottom_x[end]) - half_depth),
                    millimetres * 0.5 * (shot.bottom_r[begin] + shot.bottom_r[end]), millimetres * half_depth,
                    millimetres * 0.5 * std::abs(shot.bottom_r[end] - shot.bottom_r[begin]),
                    surface::temperature_at_time(gap.skin, trace, station, shot.time)});
  }
  const auto [coldest, hottest] = std::ranges::minmax(skin, {}, &FieldCell::value);
  std::ranges::move(skin, std::back_inserter(plot.cells));
  const auto in_kelvin = [](double value) { return in_words(value, keys::fixed(0, kelvin)); };
  plot.scales = {{"temperature of the skin [K]", coldest.value, hottest.value}};
  plot.without_value = "at most " + in_kelvin(bulk);
  plot.title = fmt::format("Gap {} at {}: the skin has {} to {}, all behind it at most {}",
                           centimetres(gap.gap), in_words(shot.time, quantity::time_in_titles),
                           fixed(coldest.value, 0), in_kelvin(hottest.value), in_kelvin(bulk));
}

/// "Pressure at 18.5 ms, gap 0.04 cm burning"
std::string subject_of(const DrawnCase& drawn, const Field& field, const ShownSnapshot& shown) {
  const auto burns = [](const run::GapResult& gap) { return gap.combustion.has_value(); };
  std::string subject = fmt::format("{} at {}", field.title.empty() ? field.meaning : field.title,
                                    in_words(shown.snapshot->time, quantity::time_in_titles));
  subject[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(subject[0])));
  if (!shown.snapshot->events.empty()) subject += ", " + events_of(*shown.snapshot, ", ");
  if (shown.gap) return subject + fmt::format(", gap {} burning", centimetres(*shown.gap));
  return subject + (std::ranges::any_of(drawn.result.gaps, burns) ? ", without burning" : "");
}

CellPlot field_plot(const DrawnCase& drawn, const Field& field, const ShownSnapshot& shown) {
  const run::Snapshot& shot = *shown.snapshot;
  CellPlot plot;
  plot.subtitle = drawn.scene.title;
  plot.scales = scales_of(drawn, field, shot);
  plot.cells = cells_of(drawn, field, shot);
  for (const BodyCells& cells : bodies_of(drawn.scene)) {
    const bool open_at_axis = cells.body->r_begin <= scene::length_tolerance(drawn.scene);
    plot.outlines.push_back({edge_of(shot, cells, open_at_axis), open_at_axis});
  }
  if (std::ranges::any_of(plot.cells, [](const FieldCell& cell) { return std::isnan(cell.value); }))
    plot.without_value = is_burnt_share(field) ? "nothing burns" : "without it";
  const run::GapResult* skin = skin_in(drawn, field, shown);
  if (skin != nullptr) draw_skin(drawn, shot, *skin, plot);
  if (skin != nullptr || is_burnt_share(field)) plot.window = window_of(plot.cells);
  if (skin == nullptr) {
    plot.title = subject_of(drawn, field, shown);
    if (!shown.gap && !drawn.result.gaps.empty()) plot.subtitle += "; the same for every gap";
  }
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

std::string lacks_fields(const DrawnCase& drawn) {
  const auto snapshots = shown_snapshots(drawn);
  if (snapshots.empty()) return "it has no snapshots; output.snapshots of the scene asks for them";
  for (const ShownSnapshot& each : snapshots) {
    const run::Snapshot& shot = *each.snapshot;
    const auto is_length = [](double length) { return length > 0.0; };
    for (const auto* lengths : {&shot.half_length_x, &shot.half_length_r})
      if (!std::ranges::all_of(*lengths, is_length)) return "a cell in its snapshots is inverted";
  }
  return {};
}

std::vector<Picture> field_pictures(const DrawnCase& drawn) {
  std::vector<Picture> pictures;
  for (const Field& field : run::snapshot_fields()) {
    if (!field.drawn || scale_groups(drawn, field).empty()) continue;
    for (const ShownSnapshot& each : chosen_snapshots(drawn)) {
      if (varies(scales_of(drawn, field, *each.snapshot)) || skin_in(drawn, field, each) != nullptr)
        pictures.push_back({fmt::format("field_{}{}.svg", field.name, name_of(each)),
                            field_plot(drawn, field, each),
                            {},
                            each.snapshot->time,
                            each.gap});
    }
  }
  return pictures;
}

/// The particles of a snapshot with all fields, for other programs.
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

std::vector<ReportTable> field_tables(const DrawnCase& drawn) {
  return study::of_each(chosen_snapshots(drawn), [&](const ShownSnapshot& each) {
    return ReportTable{sample_table(particle_quantities(drawn, *each.snapshot), each.snapshot->x.size()),
                       "field" + name_of(each) + ".csv"};
  });
}

}  // namespace

const PictureKind fields_kind{"fields",
                              "pressure, von Mises stress, crack radius, burnt share and temperature with "
                              "the skin's at every snapshot, where they vary by 1 % at least",
                              lacks_fields, field_pictures, field_tables};

}  // namespace launchsafe::report::detail
