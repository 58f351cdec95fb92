// OpenEXR, 32-bit float R, G, B: linear radiance as rendered, for tools that measure.
// Based on: Academy Software Foundation, OpenEXR 3 (https://openexr.com).
// Promise: values are stored bit for bit (ZIP compression loses nothing); alpha is left out.
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <fmt/format.h>

#include <array>
#include <cassert>
#include <exception>
#include <string>

#include "error.h"
#include "image/image.h"
#include "image/write_file.h"

namespace lamp::app {
namespace {

constexpr std::array<const char*, 3> CHANNELS{"R", "G", "B"};

std::string encode(const HdrImage& image) {
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer pixels;
  constexpr std::size_t STRIDE = sizeof(glm::vec4);
  // OpenEXR's slices are not const, though writing only reads them.
  auto* first = reinterpret_cast<char*>(const_cast<glm::vec4*>(image.pixels.data()));
  for (std::size_t channel = 0; channel < CHANNELS.size(); ++channel) {
    header.channels().insert(CHANNELS[channel], Imf::Channel(Imf::FLOAT));
    pixels.insert(CHANNELS[channel],
                  Imf::Slice(Imf::FLOAT, first + channel * sizeof(float), STRIDE, STRIDE * image.width));
  }
  Imf::StdOSStream stream;
  {
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(pixels);
    output.writePixels(static_cast<int>(image.height));
  }  // the line table is written here
  return stream.str();
}

}  // namespace

void write_exr(const std::filesystem::path& file, const HdrImage& image) {
  assert(image.pixels.size() == static_cast<std::size_t>(image.width) * image.height && "fill every pixel");
  std::string bytes;
  try {
    bytes = encode(image);
  } catch (const std::exception& failure) {
    throw Error(fmt::format("{}: cannot be encoded as EXR ({} x {} pixels): {}", file.string(), image.width,
                            image.height, failure.what()));
  }
  write_file(file, bytes);
}

}  // namespace lamp::app
