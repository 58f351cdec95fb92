// Captures that are wrong: one line that names the file, the element, what is wrong and what was expected.
// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "scene/npy.h"
#include "unit/capture_folder.h"

namespace lamp::test {
namespace {

using CaptureErrors = CaptureFolder;

/// Sets the value at `pointer` ("" as value: removes it) and expects the loader to say `says`.
struct Fault {
  std::string pointer;
  std::string value;
  std::string says;
};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> FAULTS{
      {"/version", "", "version is missing, expected 1"},
      {"/version", "2", "version is 2, expected 1"},
      {"/width", "", "width is missing, expected a whole number 1 .. 65536"},
      {"/width", "0", "width is 0, expected a whole number 1 .. 65536"},
      {"/height", "-3", "height is -3, expected a whole number 1 .. 65536"},
      {"/height", "2.5", "height is 2.5, expected a whole number 1 .. 65536"},
      {"/heigth", "3", "\"heigth\" is not a key of the format; the nearest are height"},
      {"/width", "22369622", "width is 22369622, expected a whole number 1 .. 65536"},
      {"/clip_from_view", "", "clip_from_view is missing, expected 16 numbers"},
      {"/clip_from_view", "[1, 2]", "clip_from_view has 2 elements, expected 16 numbers"},
      {"/clip_from_view", "7", "clip_from_view is 7, expected an array of 16 numbers"},
      {"/clip_from_view/3", "null", "clip_from_view[3] is null, expected a finite 32-bit number"},
      {"/clip_from_view/3", "1e300", "clip_from_view[3] is 1e+300, expected a finite 32-bit number"},
      {"/clip_from_view", "[0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,0]", "clip_from_view must be invertible, got a singular"},
      {"/clip_from_view/0", "0", "clip_from_view must be invertible, got a singular matrix"},
      {"/clip_from_view/1", "0.5", "clip_from_view[0][1] must be 0 (no shear), got 0.5"},
      {"/clip_from_view/14", "-0.5",
       "clip_from_view has depth that grows with distance, expected reversed depth (near 1, far 0)"},
      {"/view_from_world", "[0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,1]", "view_from_world must be rigid"},
      {"/view_from_world/0", "2", "view_from_world must be rigid"},
      {"/view_from_world/12", "1e38",
       "view_from_world puts the eye 9.999999680285692e+37 m from the origin, expected at"},
      {"/view_from_world/3", "1", "view_from_world[0][3] must be 0, got 1"},
      {"/depth", "", "depth is missing, expected the name of a file in the same folder that ends in .exr"},
      {"/depth", "5", "depth is 5, expected the name of a file in the same folder that ends in .exr"},
      {"/depth", "\"depth.png\"",
       "depth is \"depth.png\", expected the name of a file in the same folder that ends in .exr"},
      {"/depth", "\"/etc/depth.exr\"", "expected the name of a file in the same folder that ends in .exr"},
      {"/depth", "\"../depth.exr\"", "expected the name of a file in the same folder that ends in .exr"},
      {"/depth", "\"a/../../depth.exr\"", "expected the name of a file in the same folder that ends in .exr"},
      {"/depth_kind", "\"inverse\"", "depth_kind is \"inverse\", expected reversed, standard, linear"},
      {"/depth_kind", "\"standard\"", "clip_from_view has reversed depth (near 1, far 0), expected near 0, far 1"},
      {"/albedo", "3", "albedo is 3, expected the name of a file in the same folder that ends in .exr"},
      {"/ambient", "[1, 2]", "ambient has 2 elements, expected 3 numbers"},
      {"/ambient", "[1, 2, -1]", "ambient is [1,2,-1], expected numbers 0 .. 1e+30"},
      {"/ambient", "[1, 2, 2e30]", "ambient is [1,2,2e+30], expected numbers 0 .. 1e+30"},
      {"/lights/0/intensity", "3.4e38", "light 0: color times intensity must be at most 1e+30 candela, got "},
      {"/directional_lights", "{}", "directional_lights is {}, expected an array"},
      {"/directional_lights", R"([{"direction": [0, -2, 0], "illuminance": [1, 1, 1]}])",
       "directional light 0: direction has length 2, expected a unit vector"},
      {"/lights", "", "lights is missing, expected an array of lights or the name of a .npy file"},
      {"/lights", "5", "lights is 5, expected an array of lights or the name of a .npy file"},
      {"/lights", "\"lights.bin\"",
       "lights is \"lights.bin\", expected the name of a file in the same folder that ends in .npy"},
      {"/lights/0", "[]", "light 0: is [], expected an object"},
      {"/lights/0/colour", "[1, 1, 1]", "light 0: \"colour\" is not a key of the format; the nearest are color"},
      {"/lights/0/type", "", "light 0: type is missing, expected \"point\" or \"spot\""},
      {"/lights/0/type", "\"area\"", "light 0: type is \"area\", expected \"point\" or \"spot\""},
      {"/lights/0/position", "", "light 0: position is missing, expected 3 numbers"},
      {"/lights/0/position", "[0, -1e38, 0]",
       "light 0: position reaches 1e+38 m, expected at most 1e+15 m, as squares of distances must fit 32-bit numbers"},
      {"/lights/0/range", "-1", "light 0: range must be >= 0 m, got -1"},
      {"/lights/0/range", "\"far\"", "light 0: range is \"far\", expected a finite 32-bit number"},
      {"/lights/1/direction", "", "light 1: direction is missing, expected 3 numbers"},
      {"/lights/1/direction", "[0, 0, 0]", "light 1: direction must be finite and not 0"},
      {"/lights/1/outer_angle", "2", "light 1: outer angle must be 0 .. pi/2 radians, got 2"},
      {"/lights/1/inner_angle", "0.75", "light 1: inner angle must be 0 .. outer angle"},
  };
  return FAULTS;
}

TEST_F(CaptureErrors, TheCaptureWithoutFaultsLoads) { EXPECT_EQ(error_text(), ""); }

TEST_F(CaptureErrors, NameTheElementAndWhatWasExpected) {
  for (const Fault& fault : faults()) {
    SCOPED_TRACE(fault.pointer + " = " + fault.value);
    write("frame.json", frame_json().dump());
    change(fault.pointer, fault.value);
    expect_error("frame.json", fault.says);
  }
}

TEST_F(CaptureErrors, MoreThanMemoryHolds) {
  json frame = frame_json();
  frame["width"] = 65536;
  frame["height"] = 1025;
  write("frame.json", frame.dump());
  expect_error("frame.json", "width and height are 65536 and 1025, expected at most 67108864 pixels");
  frame = frame_json();
  frame["lights"] = std::vector<int>(1'048'577);
  write("frame.json", frame.dump());
  expect_error("frame.json", "lights has 1048577 elements, expected at most 1048576, or a .npy file");
}

TEST_F(CaptureErrors, TextThatIsNoFrame) {
  for (const auto& [text, says] :
       std::vector<std::pair<std::string, std::string>>{{"", "is no JSON: parse error at line"},
                                                        {"{\"version\": 1", "is no JSON: parse error at line"},
                                                        {"{\"range\": NaN}", "range: is no JSON: parse error at line"},
                                                        {"[1]", "is [1], expected an object"},
                                                        {"[1e999]", "is no JSON"},
                                                        {"{}", "version is missing"},
                                                        {std::string(100000, '['), "is nested too deep"}}) {
    SCOPED_TRACE(text.substr(0, 20));
    write("frame.json", text);
    expect_error("frame.json", says);
  }
}

TEST_F(CaptureErrors, EveryTruncationOfTheFrameIsAnError) {
  const std::string whole = frame_json().dump();
  for (std::size_t size = 0; size < whole.size(); size += 5) {
    write("frame.json", whole.substr(0, size));
    ASSERT_NE(error_text(), "") << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(CaptureErrors, FilesThatAreNotThere) {
  change("/lights", "\"lights.npy\"");
  expect_error("lights.npy", "is not there, expected the lights of ");
  write("frame.json", frame_json().dump());
  std::filesystem::remove(path("depth.exr"));
  expect_error("depth.exr", "is not there, expected an EXR file");
  std::filesystem::remove(path("frame.json"));
  expect_error("frame.json", "is not there, expected a capture's frame.json");
}

TEST_F(CaptureErrors, DepthOfAnotherSize) {
  change("/width", "5");
  expect_error("depth.exr", "is 4x3 pixels, expected 5x3");
}

TEST_F(CaptureErrors, EveryTruncationOfTheDepthIsAnError) {
  const std::string whole = read("depth.exr");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write("depth.exr", whole.substr(0, size));
    ASSERT_NE(error_text(), "") << size << " of " << whole.size() << " bytes";
  }
  write("depth.exr", whole.substr(0, whole.size() - 1));
  expect_error("depth.exr", "expected");
}

TEST_F(CaptureErrors, DepthThatIsNone) {
  std::vector<float> depth = frame_depth();
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -0.25F,
                            1.5F, std::numeric_limits<float>::denorm_min()}) {
    depth[6] = wrong;
    write_depth(depth);
    expect_error("depth.exr", "pixel (2, 1) is ");
    expect_error("depth.exr", "expected device depth 0 (sky) .. 1 (near)");
  }
  change("/depth_kind", "\"linear\"");
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), -1.0F, 0.25F}) {
    depth[6] = wrong;
    write_depth(depth);
    expect_error("depth.exr", "pixel (2, 1) is ");
    expect_error("depth.exr", "expected metres ahead of the eye, not before the near plane; 0 or infinity for sky");
  }
}

TEST_F(CaptureErrors, ChannelsThatAreMissing) {
  write_plane("depth.exr", {"R", "G", "B"}, {0.5F, 0.5F, 0.5F});
  expect_error("depth.exr", "channel Z is missing, expected Z among its channels (B G R)");
  write_depth(frame_depth());
  change("/normal", "\"normal.exr\"");
  write_plane("normal.exr", {"R", "G", "B"}, {0, 0, 1});
  expect_error("normal.exr", "channel X is missing, expected X Y Z among its channels (B G R)");
}

TEST_F(CaptureErrors, SurfacesOutOfRange) {
  change("/albedo", "\"albedo.exr\"");
  write_plane("albedo.exr", {"R", "G", "B"}, {0.5F, 1.5F, 0.5F});
  expect_error("albedo.exr", "albedo of pixel (0, 0), channel G, is 1.5, expected 0 .. 1");
  write_plane("albedo.exr", {"R", "G", "B"}, {0.5F, 0.5F, std::numeric_limits<float>::quiet_NaN()});
  expect_error("albedo.exr", "albedo of pixel (0, 0), channel B, is nan, expected 0 .. 1");
  change("/albedo", "");
  change("/normal", "\"normal.exr\"");
  write_plane("normal.exr", {"X", "Y", "Z"}, {0, 0, 0});
  expect_error("normal.exr", "normal of pixel (0, 0) has length 0, expected a unit vector");
}

/// Two lights, as rows.
app::Table light_table() {
  app::Table table{.columns = 16, .values = std::vector<float>(32, 0.0F)};
  for (const std::size_t row : {0U, 16U}) {
    table.values[row + 3] = 5.0F;   // range
    table.values[row + 8] = 1.0F;   // direction
    table.values[row + 12] = 0.5F;  // outer angle
  }
  table.values[16 + 13] = 1.0F;  // a spot
  return table;
}

TEST_F(CaptureErrors, LightsOfTheWrongTypeOrShape) {
  change("/lights", "\"lights.npy\"");
  const std::string whole = app::npy_bytes(light_table());
  write("lights.npy", whole);
  EXPECT_EQ(error_text(), "");
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string bytes = whole;
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  for (const auto& [bytes, says] : std::vector<std::pair<std::string, std::string>>{
           {replaced("'<f4'", "'<f8'"), "holds values of type '<f8', expected '<f4' (little-endian float32)"},
           {replaced("'<f4'", "'>f4'"), "holds values of type '>f4', expected '<f4' (little-endian float32)"},
           {replaced("False", "True "), "has fortran_order True, expected False"},
           {replaced("(2, 16)", "(16, 2)"), "has shape (16, 2), expected (N, 16)"},
           {replaced("(2, 16)", "(32,)  "), "has shape (32,), expected (N, 16)"},
           {replaced("(2, 16)", "(3, 16)"), "is truncated: it has 128 bytes of data, expected 3 rows of 64 bytes"},
           {replaced("(2, 16)", "(1, 16)"), "has 128 bytes of data, expected 1 rows of 64 bytes"},
           {replaced("(2, 16)", "(-1,16)"), "has shape (-1,16), expected (N, 16)"},
           {whole.substr(0, whole.size() - 1), "is truncated: it has 127 bytes of data"},
           {whole.substr(0, 60), "is truncated in its header"},
           {"", "does not begin as a .npy file"},
           {"PK\x03\x04", "does not begin as a .npy file"}}) {
    SCOPED_TRACE(says);
    write("lights.npy", bytes);
    expect_error("lights.npy", says);
  }
}

TEST_F(CaptureErrors, RowsThatAreNoLights) {
  change("/lights", "\"lights.npy\"");
  const auto expect_fault = [&](std::size_t value, float wrong, const std::string& says) {
    app::Table table = light_table();
    table.values[value] = wrong;
    write("lights.npy", app::npy_bytes(table));
    expect_error("lights.npy", says);
  };
  expect_fault(3, -1.0F, "light 0: range must be >= 0 m, got -1");
  expect_fault(3, std::numeric_limits<float>::quiet_NaN(), "light 0: range must be >= 0 m, got nan");
  expect_fault(16, std::numeric_limits<float>::infinity(), "light 1: position must be finite");
  expect_fault(16, -2e15F, "light 1: position reaches 2e+15 m, expected at most 1e+15 m");
  expect_fault(16 + 12, 2.0F, "light 1: outer angle must be 0 .. pi/2 radians, got 2");
  expect_fault(16 + 13, 2.0F, "light 1: type (column 13) is 2, expected 0 (point) or 1 (spot)");
  expect_fault(15, 1.0F, "light 0: column 15 is 1, expected 0 (reserved)");
}

}  // namespace
}  // namespace lamp::test
