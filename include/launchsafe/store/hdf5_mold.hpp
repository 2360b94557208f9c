// Trees of the same shape as one before: the HDF5 library lays out a file once, and the next are copies of it
// with other values in the same places. The library takes milliseconds for a case; filling a copy does not.
#pragma once

#include "launchsafe/store/hdf5.hpp"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace launchsafe::store {

/// A file and where in it which values are.
struct Hdf5Mold {
  std::string file;
  std::size_t begin = 0;  ///< of HDF5's own bytes in it
  std::vector<Hdf5Step> steps;
};

/// Puts a tree's values into a copy of a mold. Fails as soon as something is not as it was there: a name, a
/// unit, a length, the order.
class Hdf5Filler : public Hdf5Output {
 public:
  /// The mold must live as long as this does.
  explicit Hdf5Filler(const Hdf5Mold& mold) : mold_(mold) {}

  /// The bytes that the library would have written, byte by byte; the room in front is as it is in the mold.
  /// Errors: failed, when the tree is not of the mold's shape.
  Result<std::string> finish();

 private:
  bool enter(const std::string& name, const std::string& description) override;
  void leave() override;
  void put_attribute(const std::string& name, const std::string& text) override;
  void put_dataset(const Hdf5Dataset& set, const void* data) override;
  bool next_is(const Hdf5Dataset& set);

  const Hdf5Mold& mold_;
  std::size_t step_ = 0;
  std::string file_;
};

/// The molds of the last few shapes. Any thread may call any member.
class Hdf5Molds {
 public:
  /// The file that `lay_out` describes to an `Hdf5Output`, after `room_in_front` bytes for the caller's use.
  /// Errors: failed.
  template <class LayOut>
  Result<std::string> file_of(std::size_t room_in_front, const LayOut& lay_out) {
    for (const auto& mold : newest()) {
      Hdf5Filler filler(*mold);
      lay_out(static_cast<Hdf5Output&>(filler));
      Result<std::string> file = filler.finish();
      if (!file) continue;
      keep(mold);
      return file;
    }
    Hdf5Writer writer;
    lay_out(static_cast<Hdf5Output&>(writer));
    Result<std::string> file = writer.finish(room_in_front);
    if (file && file->size() <= largest)
      keep(std::make_shared<Hdf5Mold>(Hdf5Mold{*file, room_in_front, writer.steps()}));
    return file;
  }

 private:
  using Mold = std::shared_ptr<const Hdf5Mold>;
  static constexpr std::size_t most = 4, largest = 8 << 20;  ///< how many are kept, and of how many bytes

  std::vector<Mold> newest() const;
  /// Puts a mold first, and drops the one that was not used for longest.
  void keep(const Mold& mold);

  mutable std::mutex mutex_;
  std::vector<Mold> molds_;
};

}  // namespace launchsafe::store
