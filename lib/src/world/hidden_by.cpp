// Lights look around when somebody asks for them first; the maps of those that were asked for last are kept.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <list>
#include <memory>
#include <unordered_map>
#include <utility>

#include "lamplight/triangle_lists.h"

namespace lamp {
namespace {

class KeptMaps {
 public:
  KeptMaps(const StillOccluders& occluders, std::span<const shared::Light> lights, std::uint32_t texels,
           std::size_t kept)
      : occluders_(occluders),
        lights_(lights.begin(), lights.end()),
        texels_(texels),
        kept_(std::max<std::size_t>(1, kept)) {}

  bool hides(std::uint32_t light, std::span<const DVec3> hull) { return map_of(light).hides(hull); }

 private:
  using Maps = std::list<std::pair<std::uint32_t, OcclusionMap>>;  // the last asked for first

  const OcclusionMap& map_of(std::uint32_t light) {
    if (const auto known = places_.find(light); known != places_.end()) {
      maps_.splice(maps_.begin(), maps_, known->second);
      return maps_.front().second;
    }
    if (maps_.size() < kept_) {
      maps_.emplace_front(light, OcclusionMap(texels_));
    } else {
      places_.erase(maps_.back().first);
      maps_.splice(maps_.begin(), maps_, std::prev(maps_.end()));
      maps_.front().first = light;
    }
    places_[light] = maps_.begin();
    maps_.front().second.look(occluders_, lights_[light].position, lights_[light].range);
    return maps_.front().second;
  }

  const StillOccluders& occluders_;
  std::vector<shared::Light> lights_;
  std::uint32_t texels_;
  std::size_t kept_;
  Maps maps_;
  std::unordered_map<std::uint32_t, Maps::iterator> places_;
};

}  // namespace

Hides hidden_by(const StillOccluders& occluders, std::span<const shared::Light> lights, std::uint32_t texels,
                std::size_t kept_maps) {
  auto maps = std::make_shared<KeptMaps>(occluders, lights, texels, kept_maps);
  return [maps](std::uint32_t light, std::span<const DVec3> hull) { return maps->hides(light, hull); };
}

}  // namespace lamp
