// One scene written in many ways: order, tables, units, numbers, comments.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::scene {

/// digits x 10^exponent, in SI.
struct Decimal {
  std::string digits;
  int exponent = 0;
};

/// Writes the scene in a way that follows from the seed alone.
class SceneWriter {
 public:
  explicit SceneWriter(std::uint64_t seed) : random_(seed) {}

  std::string write() {
    std::vector<std::string> root, tables;
    for (auto& [section, lines] : sections()) {
      std::shuffle(lines.begin(), lines.end(), random_);
      switch (section.empty() ? 0 : pick(3)) {
        case 0:
          for (const auto& [key, value] : lines)
            root.push_back((section.empty() ? "" : section + ".") + key + equals() + value);
          break;
        case 1:
          root.push_back(section + equals() + inline_table(lines));
          break;
        default:
          tables.push_back(table("[" + section + "]", lines));
      }
    }
    tables.push_back(bodies());
    tables.push_back(table(
        "[[observation_point]]",
        {{"name", "\"G1\""}, {"x", quantity({"39", -3}, lengths())}, {"r", quantity({"1", -2}, lengths())}}));
    std::shuffle(root.begin(), root.end(), random_);
    std::shuffle(tables.begin(), tables.end(), random_);
    std::string text;
    for (const std::string& line : root) text += filler() + line + end_of_line();
    for (const std::string& each : tables) text += filler() + each;
    return text;
  }

 private:
  using Line = std::pair<std::string, std::string>;
  using Units = std::vector<std::pair<std::string, int>>;

  static Units lengths() { return {{"cm", -2}, {"mm", -3}, {"m", 0}, {"um", -6}}; }
  static Units times() { return {{"ms", -3}, {"s", 0}, {"us", -6}}; }
  static Units pressures() { return {{"MPa", 6}, {"GPa", 9}, {"Pa", 0}, {"bar", 5}}; }

  std::map<std::string, std::vector<Line>> sections() {
    return {
        {"", {{"title", "\"number " + std::to_string(pick(1000)) + "\""}, {"frame", "\"co-moving\""}}},
        {"load",
         {{"duration", quantity({"5", -5}, times())},
          {"peak", quantity({"496", 6}, pressures())},
          {"peak_time", quantity({"5", -5}, times())},
          {"exponent", number({"105", -1})}}},
        {"charge",
         {{"crack_radius", quantity({"1", -4}, lengths())},
          {"flaw_size", quantity({"13", -4}, lengths())},
          {"face_friction", number({"35", -2})},
          {"jwl.r1", number({"113", -1})},
          {"relaxation_rates", "\"0, 7320, 73200, 732000, 2000000 1/s\""}}},
        {"steel",
         {{"yield_stress", quantity({"792", 6}, pressures())}, {"taylor_quinney", number({"9", -1})}}},
        {"gap",
         {{"thickness", list({{"0", 0}, {"1", -4}, {"39", -5}}, lengths())},
          {"exchange_time", quantity({std::to_string(1 + pick(9)), -4}, times())}}},
        {"numerics", {{"cell_size", quantity({"5", -3}, lengths())}, {"particles_per_cell", plus() + "1"}}},
        {"output", {{"trace_interval", quantity({"5", -6}, times())}}},
    };
  }

  std::string bodies() {
    const Units units = lengths();
    const Decimal zero{"0", 0}, one{"1", -2}, four{"4", -2}, five{"5", -2}, inner{"15", -3}, outer{"2", -2};
    const auto body = [&](const char* name, const char* material, const std::string& x,
                          const std::string& r) {
      return table("[[body]]", {{"name", name}, {"material", material}, {"x", x}, {"r", r}});
    };
    return body("'cup'", "\"steel\"", range(zero, one, units), range(zero, outer, units)) +
           body("\"filling\"", "\"charge\"", range(one, four, units), range(zero, inner, units)) +
           body("\"wall\"", "'steel'", range(one, four, units), range(inner, outer, units)) +
           body("\"base\"", "\"steel\"", range(four, five, units), range(zero, outer, units));
  }

  std::size_t pick(std::size_t count) { return static_cast<std::size_t>(random_() % count); }
  bool chance() { return pick(2) == 0; }
  std::string plus() { return chance() ? "+" : ""; }
  std::string blanks() { return std::string(pick(3), ' '); }
  std::string equals() { return blanks() + "=" + blanks(); }
  std::string end_of_line() { return blanks() + (pick(4) == 0 ? "# a comment = 3\n" : "\n"); }
  std::string filler() {
    std::string text;
    while (pick(3) == 0) text += chance() ? "\n" : "  # another comment\n";
    return text;
  }

  std::string table(const std::string& head, std::vector<Line> lines) {
    std::shuffle(lines.begin(), lines.end(), random_);
    std::string text = head + end_of_line();
    for (const auto& [key, value] : lines)
      text += filler() + blanks() + key + equals() + value + end_of_line();
    return text;
  }
  std::string inline_table(const std::vector<Line>& lines) {
    std::string text;
    for (const auto& [key, value] : lines) text += (text.empty() ? "{ " : ", ") + key + equals() + value;
    return text + " }";
  }

  /// The decimal in a unit of 10^power, as TOML and the reader of quantities understand it.
  std::string digits(const Decimal& decimal, int power) {
    const int exponent = decimal.exponent - power;
    const std::string zeros = std::string(pick(3), '0');
    const auto count = static_cast<int>(decimal.digits.size());
    if (pick(3) == 0)
      return decimal.digits + (zeros.empty() ? "" : "." + zeros) + "e" + std::to_string(exponent);
    if (exponent >= 0) {
      return decimal.digits +
             (decimal.digits == "0" ? "" : std::string(static_cast<std::size_t>(exponent), '0')) +
             (zeros.empty() ? "" : "." + zeros);
    }
    if (count + exponent > 0) {
      const auto whole = static_cast<std::size_t>(count + exponent);
      return decimal.digits.substr(0, whole) + "." + decimal.digits.substr(whole) + zeros;
    }
    return "0." + std::string(static_cast<std::size_t>(-exponent - count), '0') + decimal.digits + zeros;
  }

  std::string number(const Decimal& decimal) { return plus() + digits(decimal, 0); }
  std::string in_unit_of(const Decimal& decimal, const Units::value_type& unit) {
    return plus() + digits(decimal, unit.second) + blanks() + unit.first;
  }
  std::string quantity(const Decimal& decimal, const Units& units) {
    return '"' + blanks() + in_unit_of(decimal, units[pick(units.size())]) + '"';
  }
  std::string range(const Decimal& begin, const Decimal& end, const Units& units) {
    const auto& unit = units[pick(units.size())];
    const std::string first =
        chance() ? in_unit_of(begin, units[pick(units.size())]) : plus() + digits(begin, unit.second);
    return '"' + first + " to " + in_unit_of(end, unit) + '"';
  }
  std::string list(const std::vector<Decimal>& decimals, const Units& units) {
    std::string text;
    const bool array = chance();
    const auto& unit = units[pick(units.size())];
    for (const Decimal& each : decimals) {
      if (!text.empty()) text += ", " + blanks();  // without a blank "1,5" might be a decimal
      text += array ? quantity(each, units) : digits(each, unit.second);
    }
    return array ? "[" + text + "]" : '"' + text + " " + unit.first + '"';
  }

  std::mt19937_64 random_;
};

/// The scene in one of its many ways.
inline std::string written_scene(std::uint64_t seed) { return SceneWriter(seed).write(); }

/// The scene that all of them are.
inline SceneFile plainly_written_scene() {
  const auto file = parse_scene(R"(
frame = "co-moving"
load = { duration = "0.05 ms", peak = "496 MPa", peak_time = "0.05 ms", exponent = 10.5 }
charge = { crack_radius = "0.1 mm", flaw_size = "1.3 mm", face_friction = 0.35, jwl.r1 = 11.3, relaxation_rates = "0, 7320, 73200, 732000, 2000000 1/s" }
steel = { yield_stress = "792 MPa", taylor_quinney = 0.9 }
gap.thickness = "0, 0.1, 0.39 mm"
numerics = { cell_size = "5 mm", particles_per_cell = 1 }
output.trace_interval = "5 us"
body = [
  { name = "cup",     material = "steel",  x = "0 to 1 cm", r = "0 to 2 cm" },
  { name = "filling", material = "charge", x = "1 to 4 cm", r = "0 to 1.5 cm" },
  { name = "wall",    material = "steel",  x = "1 to 4 cm", r = "1.5 to 2 cm" },
  { name = "base",    material = "steel",  x = "4 to 5 cm", r = "0 to 2 cm" },
]
observation_point = [ { name = "G1", x = "3.9 cm", r = "1 cm" } ]
)",
                                "plain.toml");
  EXPECT_TRUE(file) << (file ? "" : file.error().message());
  return file ? *file : SceneFile{};
}

}  // namespace launchsafe::scene
