#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "output/fields/number_format.hpp"

using namespace railwave;

TEST_CASE("numbers are rounded to their digits, to the nearest, and what is no number stays") {
  NumberFormat format;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> exponent(-300, 300), mantissa(-1, 1);
  std::vector<double> values;
  for (int k = 0; k < 10000; ++k) values.push_back(mantissa(generator) * std::pow(10, exponent(generator)));
  for (int digits : {2, 3, 4, 7}) {
    format.digits = digits;
    std::vector<double> rounded = values;
    format.round("normal_force", rounded);
    double worst = 0, mean = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double error = rounded[k] / values[k] - 1;
      worst = std::max(worst, std::fabs(error));
      mean += error / static_cast<double>(values.size());
    }
    INFO(digits << " digits: worst " << worst << ", mean " << mean);
    CHECK(worst <= 0.5 * std::pow(10, -(digits - 1)));
    CHECK(worst > 0.01 * std::pow(10, -(digits - 1)));
    CHECK(std::fabs(mean) < 0.02 * worst);
    std::vector<double> again = rounded;
    format.round("normal_force", again);
    CHECK(again == rounded);
  }
  format.digits = 3;
  const double infinite = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
  std::vector<double> odd{0.0, -0.0, infinite, -infinite, largest, std::nan("")};
  format.round("pressure", odd);
  CHECK((odd[0] == 0 && !std::signbit(odd[0]) && odd[1] == 0 && std::signbit(odd[1])));
  CHECK((odd[2] == infinite && odd[3] == -infinite && odd[4] == largest && std::isnan(odd[5])));
}

TEST_CASE("places keep all their digits, and so does everything where none are asked for") {
  const std::vector<double> values{1.23456789012345, -9.87654321e-7};
  NumberFormat three;
  three.digits = 3;
  for (const char* place : {"displacement", "position"}) {
    std::vector<double> kept = values;
    three.round(place, kept);
    CHECK(kept == values);
  }
  std::vector<double> kept = values;
  NumberFormat().round("velocity", kept);
  CHECK(kept == values);
}
