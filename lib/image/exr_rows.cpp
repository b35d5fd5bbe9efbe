#include "image/exr_rows.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfRgbaYca.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace sateen {

namespace {
constexpr int floor_to(int value, int step) {
  const int rest = value % step;
  return value - (rest < 0 ? rest + step : rest);
}

class PlainRows : public ExrRows {
 public:
  PlainRows(Imf::MultiPartInputFile& file, const ExrLayer& layer) : part_(file, layer.part), layer_(layer) {
    const Imf::ChannelList& list = part_.header().channels();
    for (const std::string& name : layer.channels) {
      const Imf::Channel* channel = name.empty() ? nullptr : list.findChannel(name);
      if (channel && (channel->xSampling != 1 || channel->ySampling != 1))
        throw std::runtime_error(fmt::format("channel {:.60} has fewer pixels than the picture", name));
    }
  }

  void read(int y, int count, float* rgb, size_t stride) override {
    const Imath::Box2i data = part_.header().dataWindow();
    Imf::FrameBuffer frame;
    for (size_t c = 0; c < 3; ++c)
      if (!layer_.channels[c].empty())
        frame.insert(layer_.channels[c],
                     Imf::Slice::Make(Imf::FLOAT, rgb + c, {data.min.x, y}, int64_t(data.max.x) - data.min.x + 1,
                                      count, 3 * sizeof(float), stride * sizeof(float)));
    part_.setFrameBuffer(frame);
    part_.readPixels(y, y + count - 1);
    if (layer_.kind != LayerKind::grey) return;
    for (int row = 0; row < count; ++row)
      for (int x = 0; x <= data.max.x - data.min.x; ++x) {
        float* p = rgb + size_t(row) * stride + 3 * size_t(x);
        p[1] = p[2] = p[0];
      }
  }

 private:
  Imf::InputPart part_;
  ExrLayer layer_;
};

/// Luminance and chroma to RGB. Chroma of every second pixel beside a luminance of half floats, as the standard tells
/// and all known writers write it, goes through OpenEXR's own filters, which work in half floats: where a colour
/// leaves their range, and for all other files, chroma is interpolated between its pixels, in floats.
class ChromaRows : public ExrRows {
 public:
  ChromaRows(const std::filesystem::path& path, Imf::MultiPartInputFile& file, const ExrLayer& layer)
      : part_(file, layer.part),
        names_(layer.channels),
        weights_(Imf::RgbaYca::computeYw(Imf::hasChromaticities(part_.header()) ? Imf::chromaticities(part_.header())
                                                                                : Imf::Chromaticities())) {
    const Imf::ChannelList& list = part_.header().channels();
    const Imf::Channel *y = list.findChannel(names_[0]), *ry = list.findChannel(names_[1]),
                       *by = list.findChannel(names_[2]);
    if (y->xSampling != 1 || y->ySampling != 1 || ry->xSampling != by->xSampling || ry->ySampling != by->ySampling)
      throw std::runtime_error(fmt::format(
          "luminance has a pixel of {} x {}, its chroma of {} x {} and {} x {}, expected of 1 x 1 and two "
          "alike",
          y->xSampling, y->ySampling, ry->xSampling, ry->ySampling, by->xSampling, by->ySampling));
    step_ = {ry->xSampling, ry->ySampling};
    if (layer.part != 0 || y->type != Imf::HALF || step_ != Imath::V2i(2)) return;
    const size_t dot = names_[0].rfind('.');
    filtered_.emplace(path.c_str(), dot == std::string::npos ? "" : names_[0].substr(0, dot),
                      Imf::globalThreadCount());
  }

  void read(int y, int count, float* rgb, size_t stride) override {
    if (!filtered_) return interpolate(y, count, rgb, stride);
    const Imath::Box2i data = filtered_->dataWindow();
    const size_t width = size_t(int64_t(data.max.x) - data.min.x + 1);
    filtered_row_.resize(width);
    for (int row = 0; row < count; ++row) {
      // One row of storage, under whatever row is asked for.
      filtered_->setFrameBuffer(filtered_row_.data() - data.min.x, 1, 0);
      filtered_->readPixels(y + row);
      bool left_range = false;
      float* const begin = rgb + size_t(row) * stride;
      for (size_t x = 0; x < width; ++x)
        for (size_t c = 0; c < 3; ++c) {
          const Imf::Rgba& from = filtered_row_[x];
          const float value = c == 0 ? from.r : c == 1 ? from.g : from.b;
          begin[3 * x + c] = value;
          left_range = left_range || !std::isfinite(value);
        }
      if (!left_range) continue;
      row_.resize(3 * width);
      interpolate(y + row, 1, row_.data(), 3 * width);
      for (size_t i = 0; i < 3 * width; ++i)
        if (!std::isfinite(begin[i])) begin[i] = row_[i];
    }
  }

 private:
  void interpolate(int y, int count, float* rgb, size_t stride) {
    const Imath::Box2i data = part_.header().dataWindow();
    const int width = data.max.x - data.min.x + 1, across = (width + step_.x - 1) / step_.x;
    const int first = floor_to(y, step_.y), last_chroma = floor_to(data.max.y, step_.y);
    const int last = std::max(y + count - 1, std::min(floor_to(y + count - 1, step_.y) + step_.y, last_chroma));
    const int rows = last - first + 1, down = (rows + step_.y - 1) / step_.y;
    luminance_.resize(size_t(width) * size_t(rows));
    for (auto& chroma : chroma_) chroma.resize(size_t(across) * size_t(down));
    Imf::FrameBuffer frame;
    const Imath::V2i origin(data.min.x, first);
    const auto insert = [&](const std::string& name, std::vector<float>& to, int columns, const Imath::V2i& step) {
      frame.insert(name, Imf::Slice::Make(Imf::FLOAT, to.data(), origin, width, rows, sizeof(float),
                                          size_t(columns) * sizeof(float), step.x, step.y));
    };
    insert(names_[0], luminance_, width, {1, 1});
    for (size_t c = 0; c < 2; ++c) insert(names_[1 + c], chroma_[c], across, step_);
    part_.setFrameBuffer(frame);
    part_.readPixels(first, last);
    for (int row = 0; row < count; ++row)
      for (int x = 0; x < width; ++x) {
        const float luminance = luminance_[size_t(y - first + row) * size_t(width) + size_t(x)];
        float* const p = rgb + size_t(row) * stride + 3 * size_t(x);
        const auto times = [&](size_t c) {
          const float ratio = 1 + chroma_at(chroma_[c], across, down, x, y - first + row);
          return luminance == 0 ? 0 : ratio * luminance;
        };
        p[0] = times(0);
        p[2] = times(1);
        p[1] = (luminance - p[0] * weights_.x - p[2] * weights_.z) / weights_.y;
      }
  }

  /// At a pixel counted from the first one that is held.
  float chroma_at(const std::vector<float>& chroma, int across, int down, int x, int y) const {
    const int i = x / step_.x, j = y / step_.y;
    const float fx = float(x % step_.x) / float(step_.x), fy = float(y % step_.y) / float(step_.y);
    const auto at = [&](int column, int row) {
      return chroma[size_t(std::min(row, down - 1)) * size_t(across) + size_t(std::min(column, across - 1))];
    };
    const auto along = [&](int row) {
      return fx == 0 ? at(i, row) : at(i, row) + fx * (at(i + 1, row) - at(i, row));
    };
    return fy == 0 ? along(j) : along(j) + fy * (along(j + 1) - along(j));
  }

  Imf::InputPart part_;
  std::array<std::string, 3> names_;
  Imath::V3f weights_;
  Imath::V2i step_{1, 1};
  std::optional<Imf::RgbaInputFile> filtered_;
  std::vector<Imf::Rgba> filtered_row_;
  std::vector<float> row_, luminance_;
  std::array<std::vector<float>, 2> chroma_;
};
}  // namespace

std::unique_ptr<ExrRows> exr_rows(const std::filesystem::path& path, Imf::MultiPartInputFile& file,
                                  const ExrLayer& layer) {
  if (layer.kind == LayerKind::chroma) return std::make_unique<ChromaRows>(path, file, layer);
  return std::make_unique<PlainRows>(file, layer);
}

}  // namespace sateen
