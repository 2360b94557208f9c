#include "launchsafe/store/hdf5_mold.hpp"

#include "hdf5_common.hpp"

#include <algorithm>
#include <cstring>

namespace launchsafe::store {

bool Hdf5Filler::next_is(const Hdf5Dataset& set) {
  if (step_ < mold_.steps.size() && mold_.steps[step_].set == set) {
    ++step_;
    return true;
  }
  fail(path_to(set.name) + " is not as it was in the mold");
  return false;
}

bool Hdf5Filler::enter(const std::string& name, const std::string& description) {
  return next_is(group_step(name, description).set);
}

void Hdf5Filler::leave() {
  if (!failed()) next_is(end_step().set);
}

void Hdf5Filler::put_attribute(const std::string& name, const std::string& text) {
  next_is(attribute_step(name, text).set);
}

void Hdf5Filler::put_dataset(const Hdf5Dataset& set, const void* data) {
  if (!next_is(set) || set.bytes() == 0) return;
  if (file_.empty()) file_ = mold_.file;
  std::memcpy(file_.data() + mold_.begin + mold_.steps[step_ - 1].offset, data, set.bytes());
}

Result<std::string> Hdf5Filler::finish() {
  if (!failed() && step_ < mold_.steps.size()) fail("there is more in the mold");
  if (failed()) return *error();
  if (file_.empty()) file_ = mold_.file;
  return std::move(file_);
}

std::vector<Hdf5Molds::Mold> Hdf5Molds::newest() const {
  const std::lock_guard lock(mutex_);
  return molds_;
}

void Hdf5Molds::keep(const Mold& mold) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find(molds_.begin(), molds_.end(), mold);
  if (found != molds_.end())
    std::rotate(molds_.begin(), found, found + 1);
  else
    molds_.insert(molds_.begin(), mold);
  if (molds_.size() > most) molds_.pop_back();
}

}  // namespace launchsafe::store
