#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::report {
namespace {

// --- elements: places and sizes in pixels, y downward; `attributes` are written as they are ---

/// Whatever would be markup is escaped; control characters become blanks.
std::string escaped(std::string_view content) {
  std::string text;
  for (const char character : content) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x20 || byte == 0x7f) {
      text += ' ';
    } else if (character == '&' || character == '<' || character == '>' || character == '"') {
      text += fmt::format("&#{};", static_cast<int>(byte));
    } else {
      text += character;
    }
  }
  return text;
}

std::string svg_line(double x1, double y1, double x2, double y2, std::string_view attributes) {
  return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", x1, y1, x2, y2,
                     attributes);
}

std::string svg_rectangle(double x, double y, double width, double height, std::string_view attributes) {
  return fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" {}/>\n", x, y, width,
                     height, attributes);
}

std::string svg_circle(double x, double y, double radius, std::string_view colour) {
  return fmt::format(
      "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"#ffffff\" "
      "stroke-width=\"1\"/>\n",
      x, y, radius, colour);
}

/// `anchor`: start, middle or end.
std::string svg_text(double x, double y, double size, std::string_view anchor, std::string_view colour,
                     std::string_view content, std::string_view attributes = "") {
  return fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\" {}>{}</text>\n", x, y,
      size, anchor, colour, attributes, escaped(content));
}

/// How wide a text will be, about, and rather too wide.
double text_width(std::string_view content, double size) {
  return 0.56 * size * static_cast<double>(display_width(content));
}

// --- what is drawn ---

// Pixels.
constexpr double page_width = 1000, margin = 88;
constexpr double panel_width = page_width - 2 * margin, most_height = 460;
constexpr double below_panel = 78, row_height = 24;

constexpr std::string_view ink = "#263238", soft_ink = "#546e7a", axis_colour = "#b23a48";

/// Cool for what is inert, warm for charges; a scene with more bodies begins again.
constexpr std::array<std::string_view, 5> inert{"#c5d3e0", "#d9d4e7", "#c3dcd3", "#aebfce", "#dfe3e6"};
constexpr std::array<std::string_view, 3> warm{"#f5d49a", "#f2b99b", "#efe3a4"};

struct DrawnBody {
  const scene::Body* body;
  bool is_charge;
  std::string_view colour;
};

/// All that is drawn, whole or in part.
struct Section {
  const scene::Scene& scene;
  scene::GridLines lines;
  std::vector<DrawnBody> bodies = {};
  std::vector<scene::ObservationPoint> points = {};  ///< stations too, with the names of all at one place
  double x_begin = 0, x_end = 0, r_end = 0;
};

/// Stations of the bottom, whose names answers have, and what the scene calls points there and elsewhere.
std::vector<scene::ObservationPoint> points_of(const scene::Scene& scene) {
  constexpr double same_place = 0.1;  // of the width of a station
  std::vector<scene::ObservationPoint> points, elsewhere = scene.output.observation_points;
  for (const scene::StationExtent& each : scene::stations_of(scene)) {
    scene::ObservationPoint& station = points.emplace_back(
        scene::ObservationPoint{each.name, each.x_end, 0.5 * (each.r_begin + each.r_end)});
    std::erase_if(elsewhere, [&](const scene::ObservationPoint& point) {
      const bool is_here = std::hypot(station.x - point.x, station.r - point.r) <=
                           same_place * (each.r_end - each.r_begin) * (1 + 1e-9);
      if (is_here) station.name += ", " + point.name;
      return is_here;
    });
  }
  points.insert(points.end(), elsewhere.begin(), elsewhere.end());
  return points;
}

Section section_of(const scene::Scene& scene) {
  Section section{.scene = scene, .lines = scene::lines_at_rest(scene), .points = points_of(scene)};
  std::size_t charges = 0, others = 0;
  for (const scene::Body& body : scene.bodies) {
    const bool charge = scene::is_charge(scene, body);
    section.bodies.push_back(
        {&body, charge, charge ? warm[charges++ % warm.size()] : inert[others++ % inert.size()]});
  }
  const scene::Extent extent = scene::extent_of(scene);
  section.x_begin = std::min(extent.x_begin, section.lines.x.front());
  section.x_end = std::max(extent.x_end, section.lines.x.back());
  section.r_end = std::max(extent.r_end, section.lines.r.back());
  return section;
}

/// A window of the section on the page: places in m, and where they are in pixels.
struct Panel {
  std::string id;
  double x_begin = 0, x_end = 0, r_end = 0;  ///< m
  double scale = 0;                          ///< pixels per m
  double top = 0;                            ///< pixels

  double width() const { return scale * (x_end - x_begin); }
  double height() const { return scale * r_end; }
  double left() const { return 0.5 * (page_width - width()); }
  double bottom() const { return top + height(); }
  double x(double place) const { return left() + scale * (place - x_begin); }
  double y(double radius) const { return bottom() - scale * radius; }
  bool shows(double place) const { return place >= x_begin && place <= x_end; }
};

/// Around the bottom of the charge, where the whole is so slender that its cells are hard to see.
std::optional<Panel> enlarged_panel(const Section& section, const Panel& whole, double top) {
  constexpr double slender = 200, height = 380, share_before_bottom = 0.7;
  if (whole.height() > slender || !scene::has_charge(section.scene)) return {};
  const double scale = height / section.r_end, length = panel_width / scale;
  const double bottom = scene::charge_extent(section.scene).x_end;
  const double begin =
      std::clamp(bottom - share_before_bottom * length, section.x_begin, section.x_end - length);
  return Panel{"enlarged", begin, begin + length, section.r_end, scale, top};
}

// --- what a panel holds ---

std::string grid_elements(const Section& section, const Panel& panel) {
  // So thin that lines one beside the other leave the colour between them visible.
  std::string text = fmt::format("<g class=\"grid\" stroke=\"{}\" stroke-width=\"0.35\">\n", soft_ink);
  for (const double x : section.lines.x) {
    if (!panel.shows(x)) continue;
    text += svg_line(panel.x(x), panel.y(section.lines.r.front()), panel.x(x),
                     panel.y(section.lines.r.back()), "class=\"x\"");
  }
  const double from = std::max(panel.x_begin, section.lines.x.front()),
               to = std::min(panel.x_end, section.lines.x.back());
  for (const double r : section.lines.r)
    text += svg_line(panel.x(from), panel.y(r), panel.x(to), panel.y(r), "class=\"r\"");
  return text + "</g>\n";
}

std::string body_elements(const Section& section, const Panel& panel, bool filled) {
  std::string text;
  for (const auto& [body, is_charge, colour] : section.bodies)
    text += svg_rectangle(
        panel.x(body->x_begin), panel.y(body->r_end), panel.scale * (body->x_end - body->x_begin),
        panel.scale * (body->r_end - body->r_begin),
        filled ? fmt::format("class=\"body\" fill=\"{}\"", colour)
               : fmt::format("class=\"edge\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\"", ink));
  return text;
}

constexpr std::string_view gap_colour = "#d55e00", load_colour = "#0072b2";
constexpr std::string_view gap_look = "class=\"gap\" stroke=\"#d55e00\" stroke-width=\"4\"",
                           load_look = "class=\"load\" stroke=\"#0072b2\" stroke-width=\"2\"";

/// The gap, which has no thickness in the grid: along the charge's bottom, and by name.
std::string gap_elements(const Section& section, const Panel& panel) {
  std::string text;
  if (section.scene.surface.gaps.empty()) return text;
  for (const auto& [body, is_charge, colour] : section.bodies)
    if (is_charge)
      text += svg_line(panel.x(body->x_end), panel.y(body->r_begin), panel.x(body->x_end),
                       panel.y(body->r_end), gap_look) +
              svg_text(panel.x(body->x_end) + 8, panel.top - 13, 14, "end", gap_colour, "gap, not to scale");
  return text;
}

/// The chamber's pressure, as arrows on the base from behind.
std::string load_elements(const Section& section, const Panel& panel) {
  constexpr int arrows = 4;
  constexpr double length = 30, head = 5;
  const scene::Extent bodies = scene::extent_of(section.scene);
  std::string text;
  if (!panel.shows(bodies.x_end)) return text;
  const double tip = panel.x(bodies.x_end) + 6;
  for (int i = 0; i < arrows; ++i) {
    const double y = panel.y((i + 0.5) / arrows * bodies.r_end);
    text += svg_line(tip, y, tip + length, y, load_look);
    for (const double side : {-head, head}) text += svg_line(tip, y, tip + head, y + side, load_look);
  }
  return text + svg_text(tip + length, panel.top - 30, 14, "end", load_colour, "chamber pressure");
}

/// On white, so that the edges of bodies do not fill its gaps.
std::string symmetry_elements(const Panel& panel) {
  constexpr double overhang = 16;
  std::string text;
  for (const std::string& look :
       {std::string("stroke=\"#ffffff\" stroke-width=\"2.4\""),
        fmt::format("class=\"symmetry\" stroke=\"{}\" stroke-width=\"1.6\" stroke-dasharray=\"16 4 3 4\"",
                    axis_colour)})
    text += svg_line(panel.left() - overhang, panel.bottom(), panel.left() + panel.width() + overhang,
                     panel.bottom(), look);
  return text;
}

std::string millimetres(double length) { return significant(1e3 * length, 6); }

std::string axis_elements(const Panel& panel) {
  constexpr double away = 12, tic = 6, size = 13;
  const double y = panel.bottom() + away, x = panel.left() - 2 * away;
  const std::string look = fmt::format("stroke=\"{}\"", soft_ink);
  std::string text = svg_line(panel.left(), y, panel.left() + panel.width(), y, look) +
                     svg_line(x, panel.bottom(), x, panel.top, look);
  const double dx = round_distance(64 / panel.scale), dr = round_distance(26 / panel.scale);
  for (double i = std::ceil(panel.x_begin / dx - 1e-9); i * dx <= panel.x_end + 1e-9 * dx; ++i) {
    text += svg_line(panel.x(i * dx), y, panel.x(i * dx), y + tic, look);
    text += svg_text(panel.x(i * dx), y + tic + size, size, "middle", soft_ink, millimetres(i * dx));
  }
  for (double i = 0; i * dr <= panel.r_end * (1 + 1e-9); ++i) {
    text += svg_line(x, panel.y(i * dr), x - tic, panel.y(i * dr), look);
    text += svg_text(x - tic - 4, panel.y(i * dr) + 0.35 * size, size, "end", soft_ink, millimetres(i * dr));
  }
  text += svg_text(panel.left() + 0.5 * panel.width(), y + tic + 2.6 * size, size, "middle", ink, "x [mm]");
  return text + svg_text(x - tic, panel.top - size, size, "end", ink, "r [mm]");
}

// --- stations and observation points ---

/// A name beside its point, moved up until it covers no other.
struct Label {
  const scene::ObservationPoint* point;
  double left = 0, width = 0, middle = 0;  ///< pixels
};

constexpr double label_size = 12, label_height = 13, label_distance = 16;

/// Those for which there is room, from the axis outward.
std::vector<Label> placed_labels(const Panel& panel, std::vector<const scene::ObservationPoint*> points) {
  std::ranges::stable_sort(points, {}, &scene::ObservationPoint::r);
  std::vector<Label> placed;
  for (const scene::ObservationPoint* point : points) {
    Label label{point, panel.x(point->x) + label_distance, text_width(point->name, label_size),
                std::min(panel.y(point->r), panel.bottom() - 0.5 * label_height)};
    const auto in_the_way = [&] {
      return std::ranges::find_if(placed, [&label](const Label& other) {
        return label.left < other.left + other.width && other.left < label.left + label.width &&
               std::abs(label.middle - other.middle) < label_height - 1e-6;
      });
    };
    for (auto other = in_the_way(); other != placed.end(); other = in_the_way())
      label.middle = other->middle - label_height;
    if (label.middle > panel.top - 2 * label_height) placed.push_back(label);
  }
  return placed;
}

std::string point_elements(const Panel& panel, const std::vector<const scene::ObservationPoint*>& points,
                           double radius) {
  std::string text;
  for (const scene::ObservationPoint* point : points)
    text += svg_circle(panel.x(point->x), panel.y(point->r), radius, ink);
  return text;
}

/// With their names; `unnamed` counts those for which there is no room.
std::string named_elements(const Panel& panel, const std::vector<const scene::ObservationPoint*>& points,
                           std::size_t& unnamed) {
  const std::vector<Label> labels = placed_labels(panel, points);
  unnamed += points.size() - labels.size();
  std::string text;
  for (const Label& label : labels)
    text += svg_line(panel.x(label.point->x), panel.y(label.point->r), label.left - 2, label.middle,
                     fmt::format("stroke=\"{}\" stroke-width=\"0.7\"", ink));
  text += point_elements(panel, points, 3.2);
  constexpr std::string_view rim =
      "paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\"";
  for (const Label& label : labels)
    text += svg_text(label.left, label.middle + 0.35 * label_size, label_size, "start", ink,
                     label.point->name, rim);
  return text;
}

std::vector<const scene::ObservationPoint*> points_in(const Section& section, const Panel& panel) {
  std::vector<const scene::ObservationPoint*> points;
  for (const scene::ObservationPoint& point : section.points)
    if (panel.shows(point.x)) points.push_back(&point);
  return points;
}

/// Bodies, grid and edges, cut off at the window, and around them axis and scales.
std::string panel_elements(const Section& section, const Panel& panel) {
  const std::string window =
      svg_rectangle(panel.left() - 1, panel.top - 1, panel.width() + 2, panel.height() + 2, "");
  return fmt::format("<clipPath id=\"{0}\">{1}</clipPath>\n<g clip-path=\"url(#{0})\">\n{2}{3}{4}</g>\n",
                     panel.id, window, body_elements(section, panel, true), grid_elements(section, panel),
                     body_elements(section, panel, false)) +
         gap_elements(section, panel) + load_elements(section, panel) + symmetry_elements(panel) +
         axis_elements(panel);
}

// --- the page ---

/// Row by row; `top` moves to below the last.
std::string legend_elements(const Section& section, double& top) {
  std::string text;
  double left = margin;
  // `sample`: elements in a square of 16 pixels whose upper left corner is the origin.
  const auto add = [&](const std::string& label, const std::string& sample) {
    constexpr double size = 14, beside = 24, between = 26;
    const double width = beside + text_width(label, size) + between;
    if (left > margin && left + width - between > page_width - margin) {
      left = margin;
      top += row_height;
    }
    text += fmt::format("<g transform=\"translate({:.2f} {:.2f})\">\n{}</g>\n", left, top, sample);
    text += svg_text(left + beside, top + 13, size, "start", ink, label);
    left += width;
  };
  for (const auto& [body, is_charge, colour] : section.bodies)
    add(body->name == body->material ? body->name : fmt::format("{} ({})", body->name, body->material),
        svg_rectangle(0, 1, 16, 14, fmt::format("fill=\"{}\" stroke=\"{}\"", colour, ink)));
  add("line of the grid", svg_line(0, 8, 16, 8, fmt::format("stroke=\"{}\"", soft_ink)));
  if (!section.points.empty()) add("station or observation point", svg_circle(8, 8, 3.2, ink));
  add(section.scene.symmetry == scene::Symmetry::axisymmetric ? "axis of symmetry" : "plane of symmetry",
      svg_line(0, 8, 16, 8,
               fmt::format("stroke=\"{}\" stroke-width=\"1.6\" stroke-dasharray=\"8 2 2 2\"", axis_colour)));
  top += row_height;
  return text;
}

/// The panels one below the other; `bottom` moves to below the last.
std::string panels(const Section& section, double& bottom) {
  const double scale = std::min(panel_width / (section.x_end - section.x_begin), most_height / section.r_end);
  const Panel whole{"whole", section.x_begin, section.x_end, section.r_end, scale, bottom};
  bottom = whole.bottom() + below_panel;
  std::string text = panel_elements(section, whole);
  auto points = points_in(section, whole);
  std::size_t unnamed = 0;
  if (const auto enlarged = enlarged_panel(section, whole, bottom + 64)) {
    const auto inside = points_in(section, *enlarged);
    // A frame around it, a little larger than the section so that it covers no edge along it.
    constexpr double above = 7, below = 5;
    text += svg_rectangle(
        whole.x(enlarged->x_begin), whole.top - above, scale * (enlarged->x_end - enlarged->x_begin),
        whole.height() + above + below,
        fmt::format("class=\"window\" fill=\"none\" stroke=\"{}\" stroke-dasharray=\"4 3\"", ink));
    text += panel_elements(section, *enlarged);
    text += svg_text(enlarged->left(), enlarged->top - 34, 16, "start", ink,
                     fmt::format("At the bottom of the charge, enlarged {} times",
                                 significant(enlarged->scale / whole.scale, 2)));
    text += named_elements(*enlarged, inside, unnamed) + point_elements(whole, inside, 2.0);
    std::erase_if(points, [&](const auto* point) { return enlarged->shows(point->x); });
    bottom = enlarged->bottom() + below_panel;
  }
  const std::string named = named_elements(whole, points, unnamed);
  if (unnamed > 0)
    text += svg_text(page_width - margin, bottom - 8, 13, "end", soft_ink,
                     fmt::format("without a name for want of room: {} points", unnamed));
  return text + named;
}

}  // namespace

std::string section_svg(const scene::Scene& scene) {
  const Section section = section_of(scene);
  const scene::Plan plan = scene::make_plan(scene);
  const scene::CellRange cells = scene::cells_of(scene);
  double bottom = 88;
  std::string text = svg_text(margin, 44, 21, "start", ink, scene.title.empty() ? "grid" : scene.title);
  text += svg_text(
      margin, 68, 14, "start", soft_ink,
      fmt::format("{} x {} cells, {} particles; time step {} at rest", cells.nx, cells.nr, plan.particles(),
                  in_words(plan.time_step, keys::significant(3, {keys::Dimension::time, "µs"}))));
  text += legend_elements(section, bottom);
  bottom += 46;
  text += panels(section, bottom);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      page_width, bottom, text);
}

}  // namespace launchsafe::report
