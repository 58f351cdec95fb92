// Performs jobs.
// SPDX-License-Identifier: Apache-2.0
#include "view/job.h"

#include <chrono>

#include "commands/pictures.h"
#include "error.h"
#include "image/image.h"
#include "scene/capture.h"

namespace lamp::app {
namespace {

constexpr std::string_view PICTURE_KINDS[] = {".png", ".exr"};

void save_picture(Stage& stage, const Job& job) {
  check_output("save picture", job.file, PICTURE_KINDS);
  const Stage::Picture picture = stage.picture(job.state, job.follows);
  write_output(job.file, [&](const std::filesystem::path& file) {
    if (file.extension() == ".exr")
      write_exr(file, picture.radiance);
    else
      write_png(file, picture.toned);
  });
}

}  // namespace

Done perform(Stage& stage, Job job) {
  const auto begin = std::chrono::steady_clock::now();
  Done done{.job = std::move(job)};
  try {
    switch (done.job.kind) {
      case Job::Kind::draw:
        done.shown = stage.draw(done.job.state, done.job.size);
        break;
      case Job::Kind::picture:
        save_picture(stage, done.job);
        break;
      case Job::Kind::capture:
        check_capture_folder(done.job.file);
        write_capture(done.job.file, stage.capture(done.job.state), LightsFormat::npy);
        break;
      case Job::Kind::prove:
        done.proof = words_of(stage.prove(done.job.state, done.job.size));
        break;
      case Job::Kind::ask:
        done.others = stage.ask_others(done.job.state, done.job.size);
        break;
    }
  } catch (const Error& error) {
    done.error = error.what();
    done.lost = done.error.find("VK_ERROR_DEVICE_LOST") != std::string::npos;
  }
  done.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return done;
}

}  // namespace lamp::app
