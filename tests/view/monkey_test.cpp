// A monkey at the window: clicks, drags, keys, text, sizes and files at random, with validation on and, in a sanitized
// build, without an error or a leak. LAMPLIGHT_MONKEY_SECONDS: how long, default 5. LAMPLIGHT_MONKEY_SEED: which
// monkey. Promise: the same seed does the same, but for when it ends.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include <chrono>
#include <cstdlib>
#include <random>

#include "view/view_test.h"

namespace lamp::app {
namespace {

double number_in(const char* variable, double otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtod(text, nullptr);
}

class Monkey {
 public:
  Monkey(Player& player, std::uint64_t seed) : player_(player), random_(seed) {}

  void act() {
    switch (below(12)) {
      case 0:
      case 1:
      case 2:
      case 3:
      case 4:
        return click();
      case 5:
        return drag();
      case 6:
      case 7:
      case 8:
        return press();
      case 9:
        return type();
      case 10:
        return scroll();
      default:
        return change_screen();
    }
  }

  /// Keeps pictures small enough to be drawn in no time.
  void calm() {
    ViewState& state = player_.viewer.state();
    Request& request = state.request;
    request.lights = std::min(request.lights, 200U);
    request.decals = std::min(request.decals, 4U);
    request.size = "64x36";
    request.size_given = true;
    state.samples = std::min(state.samples, 2U);
  }

 private:
  std::uint32_t below(std::uint32_t end) { return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(random_); }
  glm::vec2 somewhere() {
    return {static_cast<float>(below(std::max(player_.size.x, 1U))),
            static_cast<float>(below(std::max(player_.size.y, 1U)))};
  }

  void click() {
    player_.input.mouse = somewhere();
    player_.frame();
    player_.input.buttons[below(8) == 0 ? 1 : 0] = true;
    player_.frame();
    player_.input.buttons = {};
    player_.frame();
  }

  void drag() {
    player_.input.mouse = somewhere();
    player_.frame();
    player_.input.buttons[0] = true;
    for (int i = 0; i < 3; ++i) {
      player_.frame();
      player_.input.mouse = somewhere();
    }
    player_.input.buttons = {};
    player_.frame();
  }

  void press() {
    const std::string key(key_names()[below(static_cast<std::uint32_t>(key_names().size()))]);
    player_.input.held.insert(key);
    if (below(6) == 0) player_.input.held.insert("shift");
    if (below(6) == 0) player_.input.held.insert("ctrl");
    player_.input.pressed.push_back(key);
    player_.frame();
    player_.input.held.clear();
    player_.frame();
  }

  void type() {
    constexpr std::string_view LETTERS = "0123456789.:x-/=aeinf ";
    for (std::uint32_t i = below(6); i > 0; --i)
      player_.input.text += LETTERS[below(static_cast<std::uint32_t>(LETTERS.size()))];
    player_.frame();
  }

  void scroll() {
    player_.input.mouse = somewhere();
    player_.input.wheel = {0.0F, static_cast<float>(below(9)) - 4.0F};
    player_.frame();
  }

  void change_screen() {
    if (below(4) == 0) {
      player_.input.dropped.emplace_back(below(2) == 0 ? "lamp-view.json" : "nothing.glb");
    } else {
      constexpr std::array<glm::uvec2, 4> SIZES{{{720, 480}, {300, 200}, {1000, 900}, {5, 3}}};
      player_.resize(SIZES[below(4)]);
    }
    player_.frame();
  }

  Player& player_;
  std::mt19937_64 random_;
};

class MonkeyTest : public InFolder {};

TEST_F(MonkeyTest, EndsNothing) {
  using Clock = std::chrono::steady_clock;
  const double seconds = number_in("LAMPLIGHT_MONKEY_SECONDS", 5.0);
  const auto seed = static_cast<std::uint64_t>(number_in("LAMPLIGHT_MONKEY_SEED", 1.0));
  std::uint64_t acts = 0;
  try {
    run_headless(view_context(), small_viewer(), [&](Player& player) {
      Monkey monkey(player, seed);
      const Clock::time_point begin = Clock::now();
      for (; std::chrono::duration<double>(Clock::now() - begin).count() < seconds; ++acts) {
        monkey.act();
        monkey.calm();
      }
      EXPECT_FALSE(player.viewer.device_lost());
      EXPECT_GT(player.viewer.shown().number, 1);
    });
  } catch (const std::exception& error) {
    ADD_FAILURE() << "after " << acts << " acts of the monkey with seed " << seed << ": " << error.what();
  }
  RecordProperty("acts", static_cast<int>(acts));
}

}  // namespace
}  // namespace lamp::app
