// Whatever is wrong with a command line or a scene file: the exit code, and one line that names it and what was
// expected.
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

constexpr int NO_DEVICE = 3;

using BadInput = CliTest;

TEST_F(BadInput, NamesThatDoNotExistBringTheNearest) {
  expect_error(BAD_INPUT, {"rendr"}, {"command 'rendr'", "nearest are render, ", "lamp --help"});
  expect_error(BAD_INPUT, {"render", "--ligths", "5"},
               {"option '--ligths'", "nearest are --lights, ", "render --help"});
  expect_error(BAD_INPUT, {"render", "--method", "tilde"}, {"method 'tilde'", "nearest are tiled, "});
  expect_error(BAD_INPUT, {"verify", "--method", "clustred"}, {"method 'clustred'", "nearest are clustered, "});
  expect_error(BAD_INPUT, {"compare", "tiled", "al"}, {"method 'al'", "nearest are all, "});
  expect_error(BAD_INPUT, {"render", "atriun"}, {"scene 'atriun'", "nearest are atrium, ", ".gltf or .glb"});
  expect_error(BAD_INPUT, {"render", "--path", "defered"}, {"--path 'defered'", "nearest are deferred, "});
  expect_error(BAD_INPUT, {"render", "plane", "--projection", "ortho"}, {"projection 'ortho'", "orthographic"});
  expect_error(BAD_INPUT, {"render", "atrium", "--camera", "gallery", "--frame", "3"}, {"--frame 3", "no --camera"});
  expect_error(BAD_INPUT, {"render", "atrium", "--camera", "gallery", "--frames", "3..4"},
               {"--frames 3..4", "no --camera"});
  expect_error(BAD_INPUT, {"render", "--still-bytes", "4"}, {"--still-bytes 4", "expected --still-lists"});
  expect_error(BAD_INPUT, {"probe", "plane", "--at", "0", "0", "nan"}, {"--at 0 0 nan", "none beyond 1e+15"});
  expect_error(BAD_INPUT, {"probe", "plane", "--out", "p.exr"}, {"--out 'p.exr'", ".png"});
  expect_error(BAD_INPUT, {"verify", "--points", "9", "--cut", "c.txt"}, {"--cut 'c.txt'", ".png"});
  expect_error(BAD_INPUT, {"verify", "--points", "9", "--method", "auto"}, {"auto", "expected one of: world-cells"});
  for (const Arguments& ignored : {Arguments{"--mirror", "0.5"}, Arguments{"--shadows", "hard"}, Arguments{"--grow"},
                                   Arguments{"--path", "forward"}, Arguments{"--out", "m.png"}}) {
    Arguments all{"verify", "plane", "--points", "9"};
    all.insert(all.end(), ignored.begin(), ignored.end());
    expect_error(BAD_INPUT, all, {ignored.front() + ": says nothing of look-ups at points"});
  }
  expect_error(BAD_INPUT, {"probe", "plane", "--at", "1", "2"}, {"--at", "expected 3 values, got 2"});
  expect_error(BAD_INPUT, {"render", "plane", "--camera", "back"}, {"camera 'back'", "there are front"});
  expect_error(BAD_INPUT, {"render", "--brdf", "gx"}, {"--brdf 'gx'", "nearest are ggx, "});
  expect_error(BAD_INPUT, {"capture", "--out", "x", "--lights-as", "jsn"}, {"--lights-as 'jsn'", "nearest are json, "});
  expect_error(BAD_INPUT, {"verify", "--verifier", "orcle"}, {"--verifier", "'orcle'", "nearest are oracle, "});
  expect_error(BAD_INPUT, {"help", "rendr"}, {"command 'rendr'", "nearest are render, "});
  expect_error(BAD_INPUT, {"list", "methods", "tilde"}, {"method 'tilde'", "nearest are tiled, "});
  expect_error(BAD_INPUT, {"info", "atriun"}, {"scene 'atriun'", "nearest are atrium, "});
  expect_error(BAD_INPUT, {"list", "method"}, {"list 'method'", "methods"});
}

// What would be left out without a word.
TEST_F(BadInput, NamesOptionsThatWouldDoNothing) {
  expect_error(BAD_INPUT, small({"render", "--shadows", "off", "--method", "tiled", "--option", "occlusion=radial"}),
               {"--option occlusion=radial", "expected --shadows FILTER"});
  expect_error(BAD_INPUT, small({"render", "--shadows", "pcf", "--shadow-blur", "lines"}), {"--shadow-blur", "vsm"});
  expect_error(BAD_INPUT, small({"render", "--pipeline-statistics"}), {"--pipeline-statistics", "--json"});
  expect_error(BAD_INPUT, small({"render", "--depth-samples", "4", "--samples", "1"}), {"--samples: got 1"});
  expect_error(BAD_INPUT, small({"render", "--path", "standard-deferred", "--heatmap", "heat.png"}),
               {"--heatmap", "standard-deferred"});
  expect_error(BAD_INPUT, {"compare", "--panels", "posts", "--scene", "plane"}, {"--scene plane", "posts"});
  expect_error(BAD_INPUT, {"compare", "--panels", "posts", "--path", "forward"}, {"--path", "no --panels"});
  expect_error(BAD_INPUT, {"compare", "--panels", "posts", "--shadows", "soft"}, {"--shadows 'soft'"});
  expect_error(BAD_INPUT, {"probe", "plane", "--at", "0", "1", "0", "--camera", "front"}, {"--camera front", "--at"});
  expect_error(BAD_INPUT, small({"bench", "--max-lights", "3", "--out", "out"}), {"--max-lights", "leave out all"});
  expect_error(BAD_INPUT, {"render", "plane", "--size", "65537x1"}, {"--size '65537x1'", "65536"});
}

// Which is not the same as an option that is not given.
TEST_F(BadInput, EmptyValues) {
  for (const char* option : {"--heatmap", "--overlay", "--stats", "--out", "--range", "--frames", "--camera", "--size",
                             "--device", "--shader-dir", "--calibration", "--shadows", "--option"})
    expect_error(BAD_INPUT, {"render", "plane", option, ""}, {option, " '': expected a value"});
  for (const char* option : {"--out", "--cut"})
    expect_error(BAD_INPUT, {"verify", "plane", "--points", "9", option, ""}, {option, " '': expected a value"});
  for (const char* command : {"bench", "capture"})
    expect_error(BAD_INPUT, {command, "plane", "--out", ""}, {"--out '': expected a value"});
}

TEST_F(BadInput, OptionsOfAMethod) {
  const Arguments tiled{"render", "--method", "tiled", "--option"};
  const auto with = [&](const std::string& setting) {
    Arguments all = tiled;
    all.push_back(setting);
    return all;
  };
  expect_error(BAD_INPUT, with("tle=8"), {"option 'tle'", "has the options tile, "});
  expect_error(BAD_INPUT, with("tile=5"), {"option tile: '5'", "8, 16, 32"});
  expect_error(BAD_INPUT, with("tile"), {"option 'tile'", "expected KEY=VALUE"});
  expect_error(BAD_INPUT, with("tile=8\n16"), {"option tile: '8\\n16'"});
  expect_error(BAD_INPUT, {"verify", "--verifier", "cpu"}, {"--verifier", "cpu", "oracle"});
  expect_error(BAD_INPUT, {"verify", "--option", "tile=8"}, {"--option", "with --method"});
  expect_error(BAD_INPUT, {"compare", "tiled"}, {"names of two methods"});
  expect_error(BAD_INPUT, {"compare", "all", "tiled:tle=8"}, {"option 'tle'", "has the options tile, "});
  expect_error(BAD_INPUT, {"compare", "tiled:tile=5", "all"},
               {"compare 'tiled:tile=5': ", "option tile: '5'", "8, 16, 32"});
  expect_error(BAD_INPUT, {"compare", "tiled:", "all"}, {"compare 'tiled:': option ''", "expected KEY=VALUE"});
  expect_error(BAD_INPUT, {"compare", "tiled:tile=8,tile=16", "all"}, {"tile: is given twice"});
  expect_error(BAD_INPUT, {"compare", "auto:tile=8", "all"}, {"method 'auto:tile=8'", "chooses its own options"});
}

TEST_F(BadInput, Sizes) {
  for (const char* size : {"0x0", "0x8", "8x0", "8", "x", "8x8x8", "-8x8", "8.5x8", "99999999999x8", "garbage"})
    expect_error(BAD_INPUT, {"render", "--size", size}, {"--size '" + std::string(size) + "'", "WIDTHxHEIGHT"});
  expect_error(BAD_INPUT, {"render", "plane", "--lights", "1", "--size", "65000x10"},
               {"size 65000x10", "pixels a side on this device"});
}

TEST_F(BadInput, Numbers) {
  for (const char* range : {"nan:nan", "1:nan", "-1:2", "0:1", "3:2", "1:inf", "1:", ":1", "a:b", "1:2:3"})
    expect_error(BAD_INPUT, {"render", std::string("--range=") + range},
                 {"--range '" + std::string(range) + "'", "0 < MIN <= MAX"});
  for (const char* lights : {"-1", "99999999999", "16777217", "abc", "1.5", "0x10", "010"})
    expect_error(BAD_INPUT, {"render", std::string("--lights=") + lights},
                 {"--lights", "from 0 to 16777216", "'" + std::string(lights) + "'"});
  expect_error(BAD_INPUT, {"render", "--seed=-1"}, {"--seed", "whole number", "'-1'"});
  expect_error(BAD_INPUT, {"render", "--range", "1:1e7"}, {"--range '1:1e7'", "MAX <= 1000000"});
  expect_error(BAD_INPUT, {"render", "plane", "--lights", "16777216"},
               {"--lights 16777216: with the 1 of the scene plane", "at most 16777216"});
  expect_error(BAD_INPUT, {"render", "--seed", "18446744073709551616"}, {"--seed", "whole number"});
  for (const char* runs : {"0", "010", "1e3"})
    expect_error(BAD_INPUT, {"verify", "--runs", runs}, {"--runs", "from 1"});
  expect_error(BAD_INPUT, {"render", "--frame=-5"}, {"--frame", "whole number", "'-5'"});
  expect_error(BAD_INPUT, {"render", "--frames", "0"}, {"--frames", "from 1 to ", "'0'"});
  expect_error(BAD_INPUT, {"render", "--samples", "0"}, {"--samples", "from 1 to ", "'0'"});
  for (const char* spots : {"-0.5", "2", "many"})
    expect_error(BAD_INPUT, {"render", std::string("--spots=") + spots}, {"--spots"});
  expect_error(BAD_INPUT, {"render", "plane", "--spots", "nan"}, {"spots", "nan"});
  for (const char* exposure : {"0", "-1", "nan", "inf", "bright"})
    expect_error(BAD_INPUT, {"render", std::string("--exposure=") + exposure},
                 {"--exposure '" + std::string(exposure) + "'", "auto or a finite factor"});
}

// The flight is closed: a frame behind its last would be one of the same frames.
TEST_F(BadInput, FramesBehindTheFlightsLast) {
  for (const char* frame : {"300", "2147483647"}) {
    const std::string says = std::string("frame ") + frame + ": the flight of the scene plane has the frames 0 to 299";
    for (const Arguments& command :
         {Arguments{"render", "plane"}, Arguments{"verify", "plane"}, Arguments{"compare", "tiled", "all", "plane"},
          Arguments{"capture", "plane", "--out", "x"}, Arguments{"bench", "plane"}}) {
      Arguments all = command;
      all.insert(all.end(), {"--frame", frame});
      expect_error(BAD_INPUT, all, {says});
    }
  }
}

TEST_F(BadInput, OptionsThatAreGivenTwice) {
  const auto twice = [this](const Arguments& command, const std::string& option, const std::string& value) {
    Arguments all = command;
    for (int i = 0; i < 2; ++i) {
      all.push_back(option);
      if (!value.empty()) all.push_back(value);
    }
    expect_error(BAD_INPUT, all, {option, "is given 2 times, expected once"});
  };
  for (const char* command : {"render", "verify", "capture", "bench"}) {
    twice({command, "plane"}, "--size", "8x8");
    twice({command, "plane"}, "--lights", "1");
  }
  for (const char* command : {"render", "capture", "bench"}) twice({command, "plane"}, "--out", "x.png");
  for (const char* command : {"render", "compare", "bench"}) twice({command, "plane"}, "--pipeline-statistics", "");
  twice({"render"}, "--method", "tiled");
  twice({"list", "methods"}, "--json", "");
  twice({"info", "plane"}, "--json", "");
  for (const char* command : {"verify", "bench"})
    expect_error(BAD_INPUT, {command, "plane", "--method", "tiled", "--method", "tiled"},
                 {"--method tiled: is given twice"});
  expect_error(BAD_INPUT, {"render", "--method", "tiled", "--option", "tile=8", "--option", "tile=16"},
               {"--option tile: is given twice"});
  expect_error(BAD_INPUT, {"render", "plane", "--size"}, {"option '--size': expected a value"});
}

TEST_F(BadInput, ArgumentsTooMany) {
  expect_error(BAD_INPUT, {"render", "plane", "atrium"}, {"argument 'atrium'", "lamp render --help"});
  expect_error(BAD_INPUT, {"list", "scenes", "plane"}, {"argument 'plane'", "was not expected"});
  expect_error(BAD_INPUT, {"report", "a", "b", "c"}, {"results: expected at most 2, got 3"});
  expect_error(BAD_INPUT, {"-q", "render", "plane"}, {"option '-q'", "before the command", "lamp render -q"});
  expect_error(BAD_INPUT, {"list"}, {"what is required", "lamp list --help"});
}

TEST_F(BadInput, SceneFiles) {
  expect_error(BAD_INPUT, {"render", "nowhere.gltf"}, {"nowhere.gltf"});
  expect_error(BAD_INPUT, {"render", "nowhere.glb"}, {"nowhere.glb"});
  write("picture.txt", "no scene");
  expect_error(BAD_INPUT, {"render", "picture.txt"}, {"scene 'picture.txt'", ".gltf or .glb"});
  write("text.gltf", "{ this is no JSON");
  expect_error(BAD_INPUT, {"render", "text.gltf"}, {"text.gltf"});
  write("empty.glb", "");
  expect_error(BAD_INPUT, {"render", "empty.glb"}, {"empty.glb"});
}

TEST_F(BadInput, TruncatedGlb) {
  const std::filesystem::path whole =
      std::filesystem::path(LAMPLIGHT_SOURCE_DIR) / "tests/fuzz/corpus_gltf/triangle.glb";
  std::filesystem::copy_file(whole, path("cut.glb"));
  std::filesystem::resize_file(path("cut.glb"), std::filesystem::file_size(whole) / 2);
  expect_error(BAD_INPUT, {"render", "cut.glb"}, {"cut.glb"});
}

/// A triangle with a picture beside the file.
nlohmann::json textured_triangle() {
  return nlohmann::json::parse(R"({"asset": {"version": "2.0"},
    "buffers": [{"byteLength": 36, "uri":
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "images": [{"uri": "nowhere.png"}], "textures": [{"source": 0}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})");
}

TEST_F(BadInput, MissingTextureAndMissingBuffer) {
  nlohmann::json gltf = textured_triangle();
  write("scene.gltf", gltf.dump());
  expect_error(BAD_INPUT, {"render", "scene.gltf"}, {"scene.gltf", "nowhere.png"});
  gltf.erase("images");
  gltf.erase("textures");
  gltf.erase("materials");
  gltf["meshes"][0]["primitives"][0].erase("material");
  gltf["buffers"][0]["uri"] = "nowhere.bin";
  write("scene.gltf", gltf.dump());
  expect_error(BAD_INPUT, {"render", "scene.gltf"}, {"scene.gltf", "nowhere.bin"});
}

TEST_F(BadInput, IndicesThatPointToNothing) {
  nlohmann::json gltf = textured_triangle();
  gltf["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99;
  write("scene.gltf", gltf.dump());
  expect_error(BAD_INPUT, {"render", "scene.gltf"},
               {"scene.gltf: mesh 0 primitive 0: attributes POSITION is 99", "index into accessors (1 there)"});
}

TEST_F(BadInput, LightsWhoseRangeIsNone) {
  nlohmann::json gltf = textured_triangle();
  gltf["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  for (const char* range : {"-1", "0", "NaN", "1e999", "\"far\""}) {
    const nlohmann::json light{{"type", "point"}, {"range", "RANGE"}};
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = {light};
    std::string text = gltf.dump();
    text.replace(text.find("\"RANGE\""), 7, range);
    write("scene.gltf", text);
    const bool number = std::string_view(range).find_first_of("Ne") == std::string_view::npos;  // JSON knows no others
    expect_error(BAD_INPUT, {"verify", "scene.gltf"}, {number ? "light 0: range is " : "JSON: "});
  }
}

TEST_F(BadInput, OutputsThatCannotBeWritten) {
  write("file", "");
  std::filesystem::create_directory(path("folder.png"));
  expect_error(BAD_INPUT, {"render", "--out", "file/lamp.png"}, {"--out 'file/lamp.png'", "not a folder"});
  expect_error(BAD_INPUT, {"render", "--out", "file/below/lamp.png"}, {"--out", "not a folder"});
  expect_error(BAD_INPUT, {"render", "--stats", "file/stats.json"}, {"--stats 'file/stats.json'", "not a folder"});
  expect_error(BAD_INPUT, {"compare", "all", "tiled", "--out", "file/lamp.png"}, {"--out", "not a folder"});
  expect_error(BAD_INPUT, {"render", "--out", "folder.png"}, {"--out 'folder.png'", "is a folder"});
  for (const char* name : {"lamp", "lamp.jpg", "lamp.png.txt", ".png"})
    expect_error(BAD_INPUT, {"render", "--out", name}, {"--out '" + std::string(name) + "'", ".png or .exr"});
  expect_error(BAD_INPUT, {"compare", "all", "tiled", "--out", "a.exr"}, {"--out 'a.exr'", "ends in .png"});
  expect_error(BAD_INPUT, {"render", "--heatmap", "heat.jpg"}, {"--heatmap 'heat.jpg'", "ends in .png"});
  expect_error(BAD_INPUT, {"render", "--stats", "stats.txt"}, {"--stats 'stats.txt'", "ends in .json"});
  expect_error(BAD_INPUT, {"render", "--out", "a.png", "--heatmap", "./a.png"}, {"./a.png", "asked for twice"});
}

TEST_F(BadInput, AFailedRunMakesNoFolder) {
  expect_error(BAD_INPUT, {"render", "nowhere.gltf", "--out", "new/folder/lamp.png"}, {"nowhere.gltf"});
}

TEST_F(BadInput, Devices) {
  expect_error(NO_DEVICE, small({"render", "--device", "no such device"}), {"'no such device'", "found: 0 "});
  expect_error(NO_DEVICE, small({"verify", "--device", "99"}), {"'99'", "found: 0 "});
  const Environment no_driver{{"VK_DRIVER_FILES", "/nonexistent"}, {"VK_ICD_FILENAMES", "/nonexistent"}};
  for (const Arguments& command : {Arguments{"render"}, Arguments{"verify"}, Arguments{"compare", "all", "tiled"}})
    expect_error(NO_DEVICE, small(command), {"there is no Vulkan driver"}, no_driver);
  expect_error(NO_DEVICE, {"list", "devices"}, {"there is no Vulkan driver"}, no_driver);
}

TEST_F(BadInput, ShaderFolderThatIsNone) {
  expect_error(BAD_INPUT, small({"render", "--shader-dir", "nowhere"}),
               {"--shader-dir nowhere", "a checkout of Lamplight"});
}

TEST_F(BadInput, NamesOfFilesThatNoTerminalAndNoJsonCanHold) {
  const std::filesystem::path whole =
      std::filesystem::path(LAMPLIGHT_SOURCE_DIR) / "tests/fuzz/corpus_gltf/triangle.glb";
  const std::string name = "red\x1b[31mcaf\xe9.glb";
  std::filesystem::copy_file(whole, path(name));
  const nlohmann::json stats = json_of({"render", name, "--lights", "2", "--size", "16x9", "--json"});
  EXPECT_EQ(stats["scene"], "red\x1b[31mcaf\xef\xbf\xbd.glb");
  const std::string summary = output_of({"render", name, "--lights", "2", "--size", "16x9"});
  EXPECT_NE(summary.find("red\\x1b[31mcaf\\xe9.glb"), std::string::npos) << summary;
  const Arguments bench{"bench", name, "--method", "tiled", "--lights", "2", "--size", "16x9", "--frames", "1"};
  EXPECT_EQ(output_of(bench).find('\x1b'), std::string::npos);
  EXPECT_NE(read("bench/results.json").find("caf\\ufffd.glb"), std::string::npos);
  expect_error(BAD_INPUT, {"render", "\x1b[31m\xc2\x9b.glb"}, {"\\x1b[31m\\xc2\\x9b.glb: is not there"});
}

}  // namespace
}  // namespace lamp::cli
