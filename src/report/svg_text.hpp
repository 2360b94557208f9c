// Elements of an SVG picture as text. Places and sizes in pixels, y downward.
#pragma once

#include <string>
#include <string_view>

namespace launchsafe::report::detail {

/// `attributes` are written as they are.
std::string svg_line(double x1, double y1, double x2, double y2, std::string_view attributes);
std::string svg_rectangle(double x, double y, double width, double height, std::string_view attributes);
/// Filled, with a white rim, so that it stands out from lines.
std::string svg_circle(double x, double y, double radius, std::string_view colour);

/// `anchor`: start, middle or end. Whatever would be markup in the content is escaped; control characters
/// become blanks.
std::string svg_text(double x, double y, double size, std::string_view anchor, std::string_view colour,
                     std::string_view content);
/// From its left end, with a white rim.
std::string svg_haloed_text(double x, double y, double size, std::string_view colour,
                            std::string_view content);

/// How wide a text will be, about, and rather too wide.
double text_width(std::string_view content, double size);

/// What of the elements lies in a rectangle; `id` is unique in its picture.
std::string svg_clipped(std::string_view id, double x, double y, double width, double height,
                        std::string_view elements);

/// The whole file, on white.
std::string svg_page(double width, double height, std::string_view elements);

}  // namespace launchsafe::report::detail
