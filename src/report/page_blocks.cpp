#include "report/page_blocks.hpp"

#ifdef RAILWAVE_ZLIB
#include <zlib.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "case/error.hpp"

namespace railwave::page {
namespace {

constexpr std::uint16_t not_known = 65535;

/// Byte 0 of all numbers, then byte 1, and so on.
template <class Number>
std::vector<unsigned char> in_planes(const std::vector<Number>& numbers) {
  std::vector<unsigned char> bytes(numbers.size() * sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    unsigned char one[sizeof(Number)];
    std::memcpy(one, &numbers[i], sizeof(Number));
    for (std::size_t b = 0; b < sizeof(Number); ++b) bytes[b * numbers.size() + i] = one[b];
  }
  return bytes;
}

template <class Whole>
std::vector<Whole> differences(std::vector<Whole> numbers) {
  for (std::size_t i = numbers.size(); i-- > 1;) numbers[i] = static_cast<Whole>(numbers[i] - numbers[i - 1]);
  return numbers;
}

#ifdef RAILWAVE_ZLIB
std::string deflated(const std::vector<unsigned char>& bytes) {
  constexpr int compression = 9;
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes.data(), static_cast<uLong>(bytes.size()),
                compression) != Z_OK)
    throw std::runtime_error("zlib could not compress the data of the report");
  packed.resize(size);
  return packed;
}
#else
std::string deflated(const std::vector<unsigned char>&) {
  throw InputError("this program was built without zlib, which reports need: install zlib1g-dev, configure and build");
}
#endif

std::string base64(const std::string& bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b)
      three = three << 8 | (i + b < bytes.size() ? static_cast<unsigned char>(bytes[i + b]) : 0u);
    for (int place = 0; place < 4; ++place)
      text += i + static_cast<std::size_t>(place) <= bytes.size() ? letters[three >> (18 - 6 * place) & 63] : '=';
  }
  return text;
}

}  // namespace

Json PageBlocks::add_bytes(const std::vector<unsigned char>& bytes, const char* type, std::size_t count) {
  fmt::format_to(std::back_inserter(html_), "<script type=\"text/plain\" id=\"block-{}\">{}</script>\n", count_,
                 base64(deflated(bytes)));
  return {{"block", count_++}, {"type", type}, {"count", count}};
}

Json PageBlocks::add(const std::vector<double>& values) {
  const std::vector<float> single(values.begin(), values.end());
  return add_bytes(in_planes(single), "float32", single.size());
}

Json PageBlocks::add(const std::vector<std::uint32_t>& values) {
  return add_bytes(in_planes(differences(values)), "uint32", values.size());
}

Json PageBlocks::add_in_levels(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (!(low <= high)) low = high = 0;
  const double step = (high - low) / (not_known - 1);
  std::vector<std::uint16_t> levels;
  levels.reserve(values.size());
  for (const double value : values)
    levels.push_back(!std::isfinite(value) ? not_known
                     : step > 0            ? static_cast<std::uint16_t>(std::lround((value - low) / step))
                                           : std::uint16_t{0});
  Json block = add_bytes(in_planes(differences(levels)), "levels", levels.size());
  block["low"] = low;
  block["step"] = step;
  return block;
}

std::string text_for_html(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  // Outside of strings JSON has no '<'.
  for (const char letter : text) letter == '<' ? safe += "\\u003c" : safe += letter;
  return safe;
}

}  // namespace railwave::page
