// Transfers are found again for the place that they were made for, and for no other.
#include "Radiosity/Core/KeptTransfers.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

constexpr int64_t kPlaces = 1000;
constexpr int32_t kElement = 7;

/// Asks for `count` transfers at each place, `shift` away along x, and makes those that are
/// unknown.
void Pass(KeptTransfers* transfers, int32_t count, float shift) {
  transfers->ForEachPlace(kPlaces, [&](int64_t place, KeptTransfers::Cursor* cursor) {
    const Vec3f x(float(place) + shift, 0, 0);
    KeptTransfers::Transfer* kernels = cursor->Visit(kElement, x, count);
    for (int32_t i = 0; i < count; ++i) {
      if (kernels[i].visible != KeptTransfers::kUnknown) {
        EXPECT_EQ(kernels[i].kernel, x);
        continue;
      }
      kernels[i] = {x, KeptTransfers::kUnoccluded};
      cursor->CountMade();
    }
  });
}

TEST(KeptTransfersTest, FindsWhatWasMade) {
  std::atomic<int64_t> room(3 * kPlaces);
  KeptTransfers transfers(&room);
  Pass(&transfers, 3, 0);
  EXPECT_EQ(transfers.Made(), 3 * kPlaces);
  Pass(&transfers, 3, 0);
  EXPECT_EQ(transfers.Made(), 3 * kPlaces);
}

TEST(KeptTransfersTest, MakesThoseOfAnotherPlaceAnew) {
  std::atomic<int64_t> room(3 * kPlaces);
  KeptTransfers transfers(&room);
  Pass(&transfers, 3, 0);
  Pass(&transfers, 3, 0.5f);
  EXPECT_EQ(transfers.Made(), 6 * kPlaces);
  Pass(&transfers, 3, 0.5f);
  EXPECT_EQ(transfers.Made(), 6 * kPlaces);
}

TEST(KeptTransfersTest, MakesThoseOfOtherLinksAnew) {
  std::atomic<int64_t> room(3 * kPlaces);
  KeptTransfers transfers(&room);
  Pass(&transfers, 2, 0);
  Pass(&transfers, 3, 0);
  EXPECT_EQ(transfers.Made(), 5 * kPlaces);
}

// Two are asked for and one has room: that of half the places, less one that two threads at the end
// of the room leave unused.
TEST(KeptTransfersTest, KeepsNoMoreThanItMay) {
  std::atomic<int64_t> room(kPlaces), noRoom(0);
  KeptTransfers transfers(&room), none(&noRoom);
  for (KeptTransfers* kept : {&transfers, &none}) {
    Pass(kept, 2, 0);
    Pass(kept, 2, 0);
  }
  EXPECT_GE(transfers.Made(), 3 * kPlaces);
  EXPECT_LE(transfers.Made(), 3 * kPlaces + 2);
  EXPECT_EQ(none.Made(), 4 * kPlaces);
}

}  // namespace
}  // namespace lambert
