// One dispatch that answers questions of the host.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "gpu/transfer.h"
#include "render/renderer.h"

namespace lamp::app {

/// A compute shader, what it reads, and where its answers go.
struct AnswersPass {
  const char* shader = nullptr;
  std::vector<vulkan::Constant> constants;
  std::vector<vulkan::Bound> bound;  ///< read; one resource may be at several bindings
  std::uint32_t answers_at = 0;      ///< their binding
  std::span<const std::byte> push;
  glm::uvec2 groups{1};
};

/// Runs after what the renderer did last, and waits. Who destroys the buffers that were read says so to the renderer.
[[nodiscard]] vulkan::Buffer run_for_answers(Renderer& renderer, const ShaderLibrary& shaders, AnswersPass pass,
                                             std::size_t bytes);

template <class Answer>
[[nodiscard]] std::vector<Answer> answers_of(Renderer& renderer, const ShaderLibrary& shaders, AnswersPass pass,
                                             std::size_t count) {
  return first_values<Answer>(run_for_answers(renderer, shaders, std::move(pass), count * sizeof(Answer)), count);
}

}  // namespace lamp::app
