#include "Radiosity/Core/KeptTransfers.h"

#include <algorithm>

namespace lambert {

KeptTransfers::Cursor::Cursor(Block* block, std::atomic<int64_t>* room)
    : block_(block), room_(room), isRecording_(block->firstVisit.empty()) {}

void KeptTransfers::Cursor::BeginPlace(size_t place) {
  if (isRecording_) {
    block_->firstVisit.push_back(int32_t(block_->visits.size()));
    return;
  }
  next_ = size_t(block_->firstVisit[place]);
  end_ = size_t(block_->firstVisit[place + 1]);
}

KeptTransfers::Transfer* KeptTransfers::Cursor::Visit(int32_t element, const Vec3f& place,
                                                      int32_t count) {
  std::vector<Transfer>& transfers = block_->transfers;
  const int32_t first = int32_t(transfers.size());
  if (isRecording_ && room_->load() >= count && room_->fetch_sub(count) >= count) {
    block_->visits.push_back({place, element, first, count});
    transfers.resize(transfers.size() + size_t(count));
    return transfers.data() + first;
  }

  // What was kept counts for the same place alone.
  if (!isRecording_ && next_ < end_) {
    KeptTransfers::Visit& known = block_->visits[next_++];
    if (known.element == element && known.count == count) {
      Transfer* kept = transfers.data() + known.first;
      if (known.place != place) std::fill_n(kept, count, Transfer());
      known.place = place;
      return kept;
    }
  }
  forgotten_.assign(size_t(count), {});
  return forgotten_.data();
}

void KeptTransfers::Cursor::EndBlock() {
  if (!isRecording_) return;
  block_->firstVisit.push_back(int32_t(block_->visits.size()));
  block_->visits.shrink_to_fit();
  block_->transfers.shrink_to_fit();
  block_->firstVisit.shrink_to_fit();
}

int64_t KeptTransfers::Made() const {
  int64_t made = 0;
  for (const Block& block : blocks_) made += block.made;
  return made;
}

}  // namespace lambert
