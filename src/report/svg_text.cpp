#include "svg_text.hpp"

#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

namespace launchsafe::report::detail {
namespace {

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

std::string text_element(double x, double y, double size, std::string_view attributes,
                         std::string_view content) {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" {}>{}</text>\n", x, y, size,
                     attributes, escaped(content));
}

}  // namespace

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

std::string svg_text(double x, double y, double size, std::string_view anchor, std::string_view colour,
                     std::string_view content) {
  return text_element(x, y, size, fmt::format("text-anchor=\"{}\" fill=\"{}\"", anchor, colour), content);
}

std::string svg_haloed_text(double x, double y, double size, std::string_view colour,
                            std::string_view content) {
  // Twice, as not every program that shows pictures paints a stroke below its fill.
  return text_element(x, y, size,
                      "stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" fill=\"#ffffff\" "
                      "aria-hidden=\"true\"",
                      content) +
         svg_text(x, y, size, "start", colour, content);
}

double text_width(std::string_view content, double size) {
  return 0.56 * size * static_cast<double>(display_width(content));
}

std::string svg_clipped(std::string_view id, double x, double y, double width, double height,
                        std::string_view elements) {
  return fmt::format("<clipPath id=\"{}\">{}</clipPath>\n<g clip-path=\"url(#{})\">\n{}</g>\n", id,
                     svg_rectangle(x, y, width, height, ""), id, elements);
}

std::string svg_page(double width, double height, std::string_view elements) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width, height, elements);
}

}  // namespace launchsafe::report::detail
