// OpenEXR, 32-bit float: linear radiance as rendered, for tools that measure, and channels of any name.
// Based on: Academy Software Foundation, OpenEXR 3 (https://openexr.com).
// Promise: values are stored bit for bit (ZIP compression loses nothing); a picture's alpha is left out.
// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <fmt/format.h>

#include <array>
#include <cassert>
#include <exception>
#include <string>

#include "error.h"
#include "files/read_file.h"
#include "image/image.h"
#include "image/write_file.h"

namespace lamp::app {
namespace {

constexpr std::uint64_t LARGEST_FILE = std::uint64_t{1} << 32;  // bytes

/// Slices for all channels. OpenEXR's are not const, though writing only reads them.
Imf::FrameBuffer slices(const ExrPixels& pixels, const Imath::V2i& corner) {
  const std::size_t pixel_bytes = pixels.floats_per_pixel * sizeof(float);
  const std::size_t row_bytes = pixel_bytes * pixels.width;
  Imf::FrameBuffer buffer;
  for (std::size_t channel = 0; channel < pixels.channels.size(); ++channel) {
    // A slice starts where pixel (0, 0) of the file's plane would lie.
    auto* first = reinterpret_cast<char*>(const_cast<float*>(pixels.first + channel));
    const auto offset = static_cast<std::ptrdiff_t>(corner.y) * static_cast<std::ptrdiff_t>(row_bytes) +
                        static_cast<std::ptrdiff_t>(corner.x) * static_cast<std::ptrdiff_t>(pixel_bytes);
    buffer.insert(std::string(pixels.channels[channel]),
                  Imf::Slice(Imf::FLOAT, first - offset, pixel_bytes, row_bytes));
  }
  return buffer;
}

std::string encode(const ExrPixels& pixels) {
  Imf::Header header(static_cast<int>(pixels.width), static_cast<int>(pixels.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string_view name : pixels.channels)
    header.channels().insert(std::string(name), Imf::Channel(Imf::FLOAT));
  Imf::StdOSStream stream;
  {
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(slices(pixels, {0, 0}));
    output.writePixels(static_cast<int>(pixels.height));
  }  // the line table is written here
  return stream.str();
}

std::string names_of(const Imf::ChannelList& channels) {
  std::string names;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    names += fmt::format("{}{}", names.empty() ? "" : " ", channel.name());
  return names;
}

/// `name`: of the file.
void check_channels(const std::string& name, const Imf::ChannelList& channels, const ExrWanted& wanted) {
  for (const std::string_view channel_name : wanted.channels) {
    const Imf::Channel* channel = channels.findChannel(std::string(channel_name));
    if (channel == nullptr)
      throw Error(fmt::format("{}: channel {} is missing, expected {} among its channels ({})", name, channel_name,
                              fmt::join(wanted.channels, " "), names_of(channels)));
    if (channel->xSampling != 1 || channel->ySampling != 1)
      throw Error(fmt::format("{}: channel {} has {}x{} subsampling, expected a value for every pixel", name,
                              channel_name, channel->xSampling, channel->ySampling));
    if (channel->type == Imf::UINT || (wanted.full_precision && channel->type != Imf::FLOAT))
      throw Error(fmt::format("{}: channel {} holds {}, expected 32-bit floats{}", name, channel_name,
                              channel->type == Imf::UINT ? "integers" : "half floats",
                              wanted.full_precision ? "" : " or half floats"));
  }
}

std::vector<float> decode(const std::string& name, const ExrWanted& wanted) {
  Imf::InputFile input(name.c_str());
  const Imath::Box2i window = input.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width != wanted.width || height != wanted.height)
    throw Error(fmt::format("{}: is {}x{} pixels, expected {}x{}", name, width, height, wanted.width, wanted.height));
  check_channels(name, input.header().channels(), wanted);
  if (!input.isComplete()) throw Error(fmt::format("{}: is truncated, expected all of its {} lines", name, height));
  const std::size_t count = wanted.channels.size();
  std::vector<float> values(std::size_t{wanted.width} * wanted.height * count);
  input.setFrameBuffer(slices({.width = wanted.width,
                               .height = wanted.height,
                               .channels = wanted.channels,
                               .first = values.data(),
                               .floats_per_pixel = count},
                              window.min));
  input.readPixels(window.min.y, window.max.y);
  return values;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const ExrPixels& pixels) {
  std::string bytes;
  try {
    bytes = encode(pixels);
  } catch (const std::exception& failure) {
    throw Error(fmt::format("{}: cannot be encoded as EXR ({} x {} pixels): {}", file.string(), pixels.width,
                            pixels.height, failure.what()));
  }
  write_file(file, bytes);
}

void write_exr(const std::filesystem::path& file, const HdrImage& image) {
  assert(image.pixels.size() == static_cast<std::size_t>(image.width) * image.height && "fill every pixel");
  constexpr std::array<std::string_view, 3> CHANNELS{"R", "G", "B"};
  write_exr(file, ExrPixels{.width = image.width,
                            .height = image.height,
                            .channels = CHANNELS,
                            .first = reinterpret_cast<const float*>(image.pixels.data()),
                            .floats_per_pixel = 4});
}

std::vector<float> read_exr(const std::filesystem::path& file, const ExrWanted& wanted) {
  check_file(file, {.expected = "an EXR file", .most_bytes = LARGEST_FILE});
  try {
    return decode(file.string(), wanted);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {
    throw Error(fmt::format("{}: cannot be read, expected a whole EXR file: {}", file.string(), failure.what()));
  }
}

}  // namespace lamp::app
