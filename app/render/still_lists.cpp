// Uploads lists of lights that stand still.
// SPDX-License-Identifier: Apache-2.0
#include "render/still_lists.h"

#include <fmt/format.h>

#include <array>

#include "error.h"
#include "gpu/transfer.h"

namespace lamp::app {

StillLists::StillLists(Context& context)
    : StillLists(context, gpu::STILL_OFF, 0, std::array<std::uint32_t, 1>{shared::TRIANGLE_UNLIT}) {}

StillLists::StillLists(Context& context, std::uint32_t kind, std::uint32_t lights, std::span<const std::uint32_t> words)
    : kind_(kind), lights_(lights) {
  if (const std::uint64_t most = context.device().traits.max_storage_buffer_bytes; words.size_bytes() > most)
    throw Error(
        fmt::format("--still-lists: the lists take {} bytes, expected at most the {} of a buffer of this device",
                    words.size_bytes(), most));
  words_ = upload_buffer(context, "still lists", std::as_bytes(words), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

}  // namespace lamp::app
