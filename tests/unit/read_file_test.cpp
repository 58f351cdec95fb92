// Every reader takes regular files of a sensible size alone, and names what it does not take.
// SPDX-License-Identifier: Apache-2.0
#include "files/read_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <new>

#include "bench/calibration_file.h"
#include "bench/results.h"
#include "bench/suite.h"
#include "image/image.h"
#include "scene/gltf.h"
#include "unit/capture_folder.h"
#include "unit/gltf_builder.h"
#include "unit/this_system.h"

namespace lamp::test {
namespace {

namespace fs = std::filesystem;

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const app::Error& error) {
    EXPECT_EQ(error.exit(), app::Exit::bad_input);
    return error.what();
  }
  return "no error";
}

/// The name of the file that is read, and who reads it.
struct FileReader {
  std::string name;
  std::function<void(const fs::path&)> read;
};

class ReadFile : public CaptureFolder {
 protected:
  /// All that read files. Those that a glTF file or a capture names are read with it.
  [[nodiscard]] std::vector<FileReader> readers() const {
    const auto with_capture = [this](const char* key, const char* name) {
      return [this, key, name](const fs::path&) {
        json frame = frame_json();
        frame[key] = name;
        write("frame.json", frame.dump());
        static_cast<void>(load());
      };
    };
    const auto with_scene = [this](const char* array, const char* name) {
      return [this, array, name](const fs::path&) {
        GltfBuilder builder = triangle();
        builder.document["buffers"][0] = {{"byteLength", 36},
                                          {"uri", "data:application/octet-stream;base64," + base64(builder.bytes)}};
        builder.document["meshes"][0]["primitives"][0]["material"] = 0;
        builder.add("images", {{"uri", "data:image/png;base64," + std::string(PNG)}});
        builder.add("textures", {{"source", 0}});
        builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        builder.document[array][0]["uri"] = name;
        write("scene.gltf", builder.document.dump());
        static_cast<void>(app::load_gltf(path("scene.gltf")));
      };
    };
    return {
        {"a.gltf", [](const fs::path& file) { static_cast<void>(app::load_gltf(file)); }},
        {"a.glb", [](const fs::path& file) { static_cast<void>(app::load_gltf(file)); }},
        {"a.bin", with_scene("buffers", "a.bin")},
        {"image.png", with_scene("images", "image.png")},
        {"a.png", [](const fs::path& file) { static_cast<void>(app::read_png(file)); }},
        {"lights.npy", with_capture("lights", "lights.npy")},
        {"z.exr", with_capture("depth", "z.exr")},
        {"albedo.exr", with_capture("albedo", "albedo.exr")},
        {"frame.json", [this](const fs::path&) { static_cast<void>(load()); }},
        {"suite.json", [](const fs::path& file) { static_cast<void>(app::load_suite(file.string())); }},
        {"results.json", [](const fs::path& file) { static_cast<void>(app::load_results(file)); }},
        {"costs.json",
         [](const fs::path& file) { static_cast<void>(app::load_calibration(file.string(), file.string())); }},
    };
  }

  /// Makes every reader's file by `make`, and expects it to name the file and to say `says`.
  void expect_of_all(const std::function<void(const fs::path&)>& make, const std::string& says) const {
    for (const FileReader& reader : readers()) {
      SCOPED_TRACE(reader.name);
      const fs::path file = path(reader.name);
      fs::remove_all(file);
      make(file);
      const std::string error = error_of([&] { reader.read(file); });
      EXPECT_NE(error.find(reader.name), std::string::npos) << error;
      EXPECT_NE(error.find(": " + says), std::string::npos) << error;
      EXPECT_NE(error.find(", expected "), std::string::npos) << error;
      fs::remove_all(file);
    }
  }
};

TEST_F(ReadFile, MissingOnes) {
  expect_of_all([](const fs::path&) {}, "is not there");
}

TEST_F(ReadFile, Folders) {
  expect_of_all([](const fs::path& file) { fs::create_directory(file); }, "is a folder");
}

TEST_F(ReadFile, PipesThatNobodyWritesTo) {
  {
    const app::TemporaryFolder folder;
    if (!make_pipe(folder.path() / "pipe")) GTEST_SKIP() << "no named pipes here";
  }
  expect_of_all([](const fs::path& file) { ASSERT_TRUE(make_pipe(file)); }, "is not a regular file");
}

TEST_F(ReadFile, LinksToDevicesWithoutEnd) {
  if (!fs::exists("/dev/zero")) GTEST_SKIP() << "no /dev/zero here";
  expect_of_all([](const fs::path& file) { fs::create_symlink("/dev/zero", file); }, "is not a regular file");
}

TEST_F(ReadFile, FilesBeyondTheirLimit) {
  const auto make = [](const fs::path& file) {
    std::ofstream(file, std::ios::binary) << "x";
    fs::resize_file(file, std::uint64_t{1} << 34);  // takes no room on the disk
  };
  for (const FileReader& reader : readers()) {
    if (reader.name == "a.bin") continue;  // a buffer may begin a larger file
    SCOPED_TRACE(reader.name);
    fs::remove(path(reader.name));
    make(path(reader.name));
    const std::string error = error_of([&] { reader.read(path(reader.name)); });
    EXPECT_NE(error.find(reader.name), std::string::npos) << error;
    EXPECT_NE(error.find("has 17179869184 bytes, expected "), std::string::npos) << error;
    EXPECT_NE(error.find(" of at most "), std::string::npos) << error;
    fs::remove(path(reader.name));
  }
}

TEST_F(ReadFile, MemoryThatDoesNotSuffice) {
  const auto read = [] { app::within_memory("scene.gltf", [] { throw std::bad_alloc(); }); };
  EXPECT_EQ(error_of(read).find("scene.gltf: does not fit into memory, expected "), 0U);
}

}  // namespace
}  // namespace lamp::test
