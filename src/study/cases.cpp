#include "launchsafe/study/cases.hpp"

#include <utility>

namespace launchsafe::study {

const StudyCase Cases::operator[](std::size_t index) const {
  const Row& row = rows_[index];
  StudyCase made = row.own ? *row.own : make_(row.coordinates);
  made.label = row.label;
  if (complete_) complete_(made);
  return made;
}

void Cases::add(std::string label, std::vector<double> coordinates) {
  rows_.push_back({std::move(label), std::move(coordinates), nullptr});
}

void Cases::add(StudyCase made) {
  rows_.push_back({made.label, made.coordinates, std::make_shared<const StudyCase>(std::move(made))});
}

void Cases::replace(std::size_t index, StudyCase made) {
  rows_[index] = {made.label, made.coordinates, std::make_shared<const StudyCase>(std::move(made))};
}

}  // namespace launchsafe::study
