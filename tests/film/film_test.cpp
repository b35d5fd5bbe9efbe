#include "film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "film/develop.h"
#include "film/error.h"
#include "statistics/z_test.h"

namespace sateen {
namespace {

FilmPixel pixel_of(const std::vector<Color>& samples) {
  FilmPixel pixel;
  for (const Color& c : samples) add_sample(pixel, c, 1, 0x1p-33);
  return pixel;
}

TEST(FilmPixel, MeanIsTheMeanOfAllSamples) {
  std::vector<Color> samples;
  Color sum(0);
  for (int i = 0; i < 23; ++i) {
    samples.push_back(Color(float(i), float(i * i), 1 - float(i)));
    sum += samples.back();
    const Color mean = pixel_mean(pixel_of(samples));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], sum[c] / float(i + 1), 1e-4f) << i;
  }
  EXPECT_EQ(pixel_mean(FilmPixel()), Color(0));
}

TEST(FilmPixel, VarianceOfEqualReplicatesIsTheirScatterOverTheirNumber) {
  // Replicate means 1, 2, 4, 9: mean 4, sum of squares 9 + 4 + 0 + 25, over (4 - 1) and over 4.
  std::vector<Color> samples;
  for (int round = 0; round < 3; ++round)
    for (const float m : {1.0f, 2.0f, 4.0f, 9.0f}) samples.push_back(Color(m, 2 * m, 0));
  const Vec3d variance = pixel_variance(pixel_of(samples));
  EXPECT_NEAR(variance.x, 38.0 / 12, 1e-5);
  EXPECT_NEAR(variance.y, 4 * 38.0 / 12, 1e-5);
  EXPECT_EQ(variance.z, 0);
}

TEST(FilmPixel, VarianceIsUnknownBelowTwoReplicates) {
  EXPECT_EQ(pixel_variance(FilmPixel()), Vec3d(0));
  EXPECT_EQ(pixel_variance(pixel_of({Color(3)})), Vec3d(0));
  EXPECT_GT(pixel_variance(pixel_of({Color(3), Color(4)})).x, 0);
}

// Samples of unit variance: the mean of n has variance 1 / n, whatever n. 40,000 pixels a count; deviates are below
// the bound in all but 1e-4 of runs.
TEST(FilmPixel, VarianceIsUnbiasedForEveryNumberOfSamples) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal(5, 1);
  const std::vector<int> counts{2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 30};
  const double bound = sateen_test::sidak_deviate(1e-4, double(counts.size()));
  for (const int n : counts) {
    sateen_test::Batches estimate;
    for (int k = 0; k < 40000; ++k) {
      FilmPixel pixel;
      for (int i = 0; i < n; ++i) add_sample(pixel, Color(normal(random)), 1, 0x1p-33);
      estimate.add(double(pixel_variance(pixel).x) * n);
    }
    EXPECT_LT(std::abs(sateen_test::difference_deviate(estimate, 1.0)), bound) << n << " samples: " << estimate.mean;
  }
}

struct Noise {
  double mean, deviation;  ///< of one replicate's mean
};

/// A film whose replicates are normal about a mean that is known; the same number of samples everywhere.
template <class NoiseAt>
Film noisy_film(int width, int height, std::mt19937& random, NoiseAt&& noise_at) {
  Film film(width, height, false);
  std::normal_distribution<double> normal;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      FilmPixel& pixel = film.pixels[size_t(y * width + x)];
      const Noise noise = noise_at(x, y);
      pixel.samples = replicates;
      pixel.coverage = {1, 1, 1, 1};
      for (Vec3d& c : pixel.beauty)
        for (int i = 0; i < 3; ++i) c[i] = noise.mean + noise.deviation * normal(random);
    }
  return film;
}

// What the film is off by in truth, relative as E is: its means are known.
template <class NoiseAt>
double real_error(const Film& film, NoiseAt&& noise_at) {
  double sum = 0;
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      const double mean = noise_at(x, y).mean;
      const Color off = pixel_mean(film.pixels[size_t(y * film.width + x)]) - Color(float(mean));
      for (int c = 0; c < 3; ++c) sum += double(off[c]) * double(off[c]) / (mean * mean + 0.01) / 3;
    }
  return std::sqrt(sum / (film.width * film.height));
}

template <class NoiseAt>
double expected_error(int width, int height, NoiseAt&& noise_at) {
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Noise n = noise_at(x, y);
      sum += n.deviation * n.deviation / replicates / (n.mean * n.mean + 0.01);
    }
  return std::sqrt(sum / (width * height));
}

struct Coverage {
  int inside = 0;
  sateen_test::Batches ratio;  ///< of E to what is expected, squared
};

template <class NoiseAt>
Coverage coverage(int width, int height, int runs, NoiseAt&& noise_at) {
  std::mt19937 random(5);
  const double expected = expected_error(width, height, noise_at);
  Coverage c;
  for (int run = 0; run < runs; ++run) {
    const Film film = noisy_film(width, height, random, noise_at);
    const PictureError e = picture_error(film, ErrorScale());
    EXPECT_TRUE(e.known);
    EXPECT_LE(e.low, e.error);
    EXPECT_LE(e.error, e.high);
    const double real = real_error(film, noise_at);
    c.inside += e.low <= real && real <= e.high;
    c.ratio.add(e.error * e.error / (expected * expected));
  }
  return c;
}

// Mean pixel values far above the noise, so that the denominator of E is known as well. The interval shall hold what
// each of 600 films is really off by in 95 % of them: between 92 and 98 %, which it leaves by chance in less than
// 1e-3 of runs.
TEST(PictureError, IntervalHoldsWhatThePictureIsReallyOffByAsOftenAsItSays) {
  const auto flat = [](int, int) { return Noise{2, 0.05}; };
  const Coverage c = coverage(128, 96, 600, flat);
  EXPECT_GE(c.inside, 552);
  EXPECT_LE(c.inside, 588);
  // And E itself is unbiased: 1e-3.
  EXPECT_LT(std::abs(sateen_test::difference_deviate(c.ratio, 1.0)), sateen_test::two_sided_deviate(1e-3))
      << c.ratio.mean;
}

TEST(PictureError, IntervalHoldsWhereNoiseDiffersFromPlaceToPlace) {
  const auto lit_half = [](int x, int) { return x < 80 ? Noise{0.5, 0.02} : Noise{0.1, 0}; };
  EXPECT_GE(coverage(160, 64, 200, lit_half).inside, 178);
  const auto ramp = [](int x, int y) { return Noise{1.0 + y / 40.0, 0.001 + x / 4000.0}; };
  EXPECT_GE(coverage(160, 64, 200, ramp).inside, 178);
  // One pixel in 50 carries nearly all of the noise.
  const auto specks = [](int x, int y) { return Noise{1.0, (x * 7 + y * 13) % 50 == 0 ? 0.1 : 0.001}; };
  EXPECT_GE(coverage(160, 64, 200, specks).inside, 178);
}

// Half own, half of eight neighbours, 2.1 to either side: 95 % +- 1 of pixels where neighbours are alike, and where
// the noise runs over a factor of nine. 19,200 pixels are enough to tell to 0.5 % at 1e-3.
TEST(PooledVariances, IntervalsHoldTheTruthOfThePixels) {
  std::mt19937 random(7);
  const auto flat = [](int, int) { return Noise{2, 0.05}; };
  const auto ramp = [](int x, int) { return Noise{1.0, 0.01 + x / 2000.0}; };
  const auto share = [&](auto&& noise_at) {
    const Film film = noisy_film(160, 120, random, noise_at);
    const std::vector<Vec3d> variances = pooled_variances(film);
    int inside = 0;
    for (size_t i = 0; i < film.pixels.size(); ++i) {
      const double mean = noise_at(int(i) % 160, int(i) / 160).mean;
      inside += std::abs(double(pixel_mean(film.pixels[i]).y) - mean) <= interval_factor * std::sqrt(variances[i].y);
    }
    return double(inside) / double(film.pixels.size());
  };
  EXPECT_NEAR(share(flat), 0.945, 0.01);
  EXPECT_NEAR(share(ramp), 0.945, 0.01);
}

TEST(DeviationOfShare, IsWhatNinetyFivePercentOfPixelsKeepWithin) {
  std::mt19937 random(7);
  // Deviates of the three channels are independent here: of their root mean square 95 % lie below 1.61.
  // A normal deviate, as of channels that are off together, gives 1.96; the sentence is made for that.
  const auto flat = [](int, int) { return Noise{3, 0.06}; };
  const double each = 0.06 / 2 / std::sqrt(9.01);
  const Film film = noisy_film(160, 120, random, flat), empty(8, 8, false);
  EXPECT_NEAR(deviation_of_share(film, pixel_errors(film, {})), 1.96 * each, 0.05 * each);
  EXPECT_EQ(deviation_of_share(empty, pixel_errors(empty, {})), 0);
}

/// Films whose pixels are all light of one mean, in samples like those of a glint: mostly dark, rarely bright.
Film glinting_film(int side, int samples, double chance, std::mt19937& random) {
  Film film(side, side, false);
  std::uniform_real_distribution<double> u;
  for (FilmPixel& pixel : film.pixels)
    for (int i = 0; i < samples; ++i)
      add_sample(pixel, Color(u(random) < chance ? float(0.5 / chance) : 0.0f), 1, film.grain);
  return film;
}

double real_error_of_flat(const Film& film, double mean) {
  double sum = 0;
  for (const FilmPixel& pixel : film.pixels) sum += std::pow(double(pixel_mean(pixel).x) - mean, 2);
  return std::sqrt(sum / double(film.pixels.size()) / (mean * mean + 0.01));
}

// A pixel that is too bright by chance must not excuse itself: at a chance of one in 20, E of its own value was 0.4
// of the real one after 4 samples. Over 40 films of 4,096 pixels a mean ratio is known to 0.5 %.
TEST(PictureError, IsTheRealOneWhereFewSamplesCarryTheLight) {
  std::mt19937 random(17);
  for (const int samples : {3, 4, 8, 16, 32})
    for (const double chance : {0.3, 0.05}) {
      double claimed = 0, real = 0;
      int inside = 0;
      for (int run = 0; run < 40; ++run) {
        const Film film = glinting_film(64, samples, chance, random);
        const PictureError e = picture_error(film, ErrorScale());
        const double off = real_error_of_flat(film, 0.5);
        claimed += e.error, real += off;
        inside += e.low <= off && off <= e.high;
      }
      // Where not even the neighbours have seen one it is too large rather than too small.
      EXPECT_NEAR(claimed / real, 1, samples * chance < 0.2 ? 0.3 : 0.1)
          << samples << " samples, one in " << 1 / chance;
      EXPECT_GE(inside, 36) << samples << " samples, one in " << 1 / chance;
    }
}

// The same cloth before more nothing has the same E.
TEST(PictureError, DoesNotCountWhatNothingIsRenderedIn) {
  std::mt19937 random(3);
  const Film film = noisy_film(64, 48, random, [](int, int) { return Noise{1, 0.1}; });
  Film larger(64, 96, false);
  std::copy(film.pixels.begin(), film.pixels.end(), larger.pixels.begin());
  for (size_t i = film.pixels.size(); i < larger.pixels.size(); ++i) larger.pixels[i].samples = replicates;
  const double alone = picture_error(film, ErrorScale()).error,
               before_nothing = picture_error(larger, ErrorScale()).error;
  EXPECT_NEAR(before_nothing / alone, 1, 0.02);
  const double one = deviation_of_share(film, pixel_errors(film, {})),
               two = deviation_of_share(larger, pixel_errors(larger, {}));
  EXPECT_NEAR(two / one, 1, 0.02);
}

TEST(PictureError, OfAShadowInTheAlphaIsThatOverGrey) {
  std::mt19937 random(5);
  std::normal_distribution<float> shadow(0.5f, 0.2f);
  Film film(64, 64, false);
  double off = 0;
  for (FilmPixel& pixel : film.pixels) {
    for (int i = 0; i < 8; ++i) add_sample(pixel, Color(0), shadow(random), film.grain);
    off += std::pow(0.18 * (pixel_coverage(pixel) - 0.5), 2) / (0.09 * 0.09 + 0.01);
  }
  const double real = std::sqrt(off / double(film.pixels.size()));
  EXPECT_NEAR(picture_error(film, ErrorScale()).error / real, 1, 0.05);
  film.opaque = true;  // before a backdrop there is no alpha
  EXPECT_EQ(picture_error(film, ErrorScale()).error, 0);
}

TEST(PictureError, CountsAtTheDisplaysExposure) {
  std::mt19937 random(5);
  Film film = noisy_film(32, 32, random, [](int, int) { return Noise{0.2, 0.1}; });
  const double error = picture_error(film, ErrorScale{error_floor_at(0)}).error;
  for (FilmPixel& pixel : film.pixels)
    for (Vec3d& sum : pixel.beauty) sum *= 0x1p-12;
  EXPECT_DOUBLE_EQ(picture_error(film, ErrorScale{error_floor_at(12)}).error, error);
}

TEST(PictureError, IsFiniteUnderASunOfAnyStrength) {
  for (const double light : {1e19, 1e30, 1e38}) {
    Film film(8, 8, false);
    film.grain = light * 0x1p-33;
    for (FilmPixel& pixel : film.pixels)
      for (int i = 0; i < 8; ++i) add_sample(pixel, Color(i % 3 ? 0.0f : float(light)), 1, film.grain);
    const std::vector<PixelError> errors = pixel_errors(film, {});
    const PictureError e = picture_error(film, errors);
    EXPECT_TRUE(std::isfinite(e.error) && std::isfinite(e.high) && e.low > 0) << light;
    EXPECT_TRUE(std::isfinite(deviation_of_share(film, errors))) << light;
    for (const ImageLayer& layer : develop_layers(film))
      for (const float v : layer.image.pixels) ASSERT_TRUE(std::isfinite(v)) << light << " " << layer.name;
  }
}

// One pixel that carries all of it: what it is off by over what it says is a Student's t of 3 degrees of freedom, and
// the interval's end its 97.5 % point, 3.18. Of 2,000 pixels 95 % +- 1.5 lie below.
TEST(PictureError, OfOnePixelEndsWhereStudentsTDoes) {
  std::mt19937 random(31);
  std::normal_distribution<double> normal;
  int below = 0;
  for (int run = 0; run < 2000; ++run) {
    Film film = noisy_film(16, 16, random, [](int, int) { return Noise{1, 0}; });
    Vec3d sum(0);
    for (Vec3d& c : film.pixels[100].beauty) {
      c = Vec3d(1 + 0.2 * normal(random));
      sum += c;
    }
    const PictureError e = picture_error(film, ErrorScale());
    const double real = std::abs(sum.x / 4 - 1) / std::sqrt(1.01) / 16;
    below += real <= e.high;
    EXPECT_LT(e.high / e.error, 4);
    EXPECT_TRUE(e.rests_on_rare_samples);
  }
  EXPECT_NEAR(below, 1900, 30);
}

TEST(PictureError, HasTheSameBitsOnAnyNumberOfThreads) {
  std::mt19937 random(23);
  const Film film = glinting_film(37, 7, 0.2, random);
  EXPECT_EQ(picture_error(film, ErrorScale{0.1, 1}).high, picture_error(film, ErrorScale{0.1, 3}).high);
}

TEST(AddFilm, GivesTheBitsOfOneFilmOfAllSamplesInAnyOrder) {
  std::mt19937 random(11);
  std::lognormal_distribution<float> light(-2, 3);
  Film whole(4, 4, false), first(4, 4, false), second(4, 4, false);
  for (int i = 0; i < 4096; ++i)
    for (size_t k = 0; k < whole.pixels.size(); ++k) {
      const Color value(light(random), light(random), light(random));
      add_sample(whole.pixels[k], value, 0.3f, whole.grain);
      add_sample((i < 1024 ? first : second).pixels[k], value, 0.3f, whole.grain);
    }
  add_film(second, first);
  for (size_t k = 0; k < whole.pixels.size(); ++k) {
    for (size_t r = 0; r < replicates; ++r) EXPECT_EQ(second.pixels[k].beauty[r], whole.pixels[k].beauty[r]);
    EXPECT_EQ(second.pixels[k].coverage, whole.pixels[k].coverage);
    EXPECT_EQ(second.pixels[k].samples, whole.pixels[k].samples);
  }
}

// Pairs of replicates are compared, and the two others say what with: of 1, 2, 4, 9 the pair 1, 2 with 6.5 ...
TEST(PictureError, OfOnePixelComparesPairsOfReplicatesWithTheOthers) {
  Film film(1, 1, false);
  film.pixels[0] = pixel_of({Color(1), Color(2), Color(4), Color(9)});
  const PictureError e = picture_error(film, ErrorScale());
  ASSERT_TRUE(e.known);
  const double pairs = 1 / 42.26 + 9 / 30.26 + 64 / 9.01 + 4 / 25.01 + 49 / 6.26 + 25 / 2.26;
  EXPECT_NEAR(e.error, std::sqrt(pairs / 48), 1e-6);
}

TEST(PictureError, PixelsWithoutSamplesDoNotCount) {
  std::mt19937 random(3);
  const auto flat = [](int, int) { return Noise{1, 0.1}; };
  Film film = noisy_film(64, 48, random, flat);
  Film larger(64, 96, false);
  std::copy(film.pixels.begin(), film.pixels.end(), larger.pixels.begin());
  EXPECT_EQ(picture_error(film, ErrorScale()).error, picture_error(larger, ErrorScale()).error);
  EXPECT_FALSE(picture_error(Film(8, 8, true), ErrorScale()).known);
}

TEST(PictureError, ADarkPictureIsJudgedAgainstATenth) {
  std::mt19937 random(3);
  const double e = picture_error(noisy_film(64, 64, random,
                                            [](int, int) {
                                              return Noise{0, 0.002};
                                            }),
                                 ErrorScale())
                       .error;
  EXPECT_NEAR(e, 0.002 / 2 / 0.1, 0.0005);
}

Film random_film() {
  Film film(7, 5, true);
  std::mt19937 random(9);
  const auto r = [&] { return float(random() % 100000) / 10000; };
  const auto color = [&] { return Color(r(), r(), r()); };
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    FilmPixel& pixel = film.pixels[i];
    LayerPixel& layer = film.layers[i];
    const int n = int(i % 9);  // the first, the tenth ... have none
    for (int k = 0; k < n; ++k) {
      Color total(0);
      for (Color* part : {&layer.surface[0], &layer.surface[1], &layer.volume[0], &layer.volume[1],
                          &layer.indirect.bounce[0], &layer.indirect.bounce[1], &layer.indirect.bounce[2],
                          &layer.indirect.bounce[3], &layer.through_gaps, &layer.backdrop}) {
        const Color c = color();
        *part += c;
        total += c;
      }
      add_sample(pixel, total, k % 2 ? 1.0f : 0.25f, 0x1p-33);
      if (k % 3 == 0) continue;
      ++layer.hits;
      layer.albedo += Color(0.25f, 0.5f, 0.75f);
      layer.normal += Vec3(0, 0, 1);
      layer.warp += Vec3(1, 0, 0);
      layer.position += Vec3(float(i), 2, 3);
      layer.uv += Vec2(0.5f, float(i));
    }
  }
  return film;
}

const ImageLayer& named(const std::vector<ImageLayer>& all, const std::string& name) {
  for (const ImageLayer& layer : all)
    if (layer.name == name) return layer;
  throw std::runtime_error("no layer " + name);
}

void expect_sum(const std::vector<ImageLayer>& all, const std::string& whole, const std::vector<std::string>& parts) {
  const Image& sum = named(all, whole).image;
  for (int y = 0; y < sum.height; ++y)
    for (int x = 0; x < sum.width; ++x)
      for (int c = 0; c < 3; ++c) {
        double added = 0;
        for (const std::string& part : parts) added += double(named(all, part).image.at(x, y)[c]);
        EXPECT_NEAR(sum.at(x, y)[c], added, 4e-6 * (1 + std::abs(added))) << whole << " at " << x << ", " << y;
      }
}

TEST(Layers, AddUpToTheBeauty) {
  const std::vector<ImageLayer> all = develop_layers(random_film());
  expect_sum(all, "", {"surface", "volume", "indirect", "through_gaps", "backdrop"});
  expect_sum(all, "", {"direct", "indirect", "through_gaps", "backdrop"});
  expect_sum(all, "indirect", {"indirect_1", "indirect_2", "indirect_3", "indirect_more"});
  expect_sum(all, "direct", {"warp_surface", "warp_volume", "weft_surface", "weft_volume"});
  expect_sum(all, "surface", {"warp_surface", "weft_surface"});
  expect_sum(all, "volume", {"warp_volume", "weft_volume"});
}

TEST(Layers, GeometryIsAMeanOverTheSamplesThatMetCloth) {
  const Film film = random_film();
  const std::vector<ImageLayer> all = develop_layers(film);
  const std::vector<Vec3d> pooled = pooled_variances(film);
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      const size_t i = size_t(y * film.width + x);
      const float met = film.layers[i].hits ? 1.0f : 0.0f;
      EXPECT_FLOAT_EQ(named(all, "albedo").image.at(x, y)[1], 0.5f * met);
      EXPECT_FLOAT_EQ(named(all, "N").image.at(x, y)[2], met);
      EXPECT_FLOAT_EQ(named(all, "warp").image.at(x, y)[0], met);
      EXPECT_FLOAT_EQ(named(all, "P").image.at(x, y)[0], float(i) * met);
      EXPECT_FLOAT_EQ(named(all, "uv").image.at(x, y)[1], float(i) * met);
      EXPECT_EQ(named(all, "samples").image.at(x, y)[0], float(film.pixels[i].samples));
      const Vec3d variance = pooled[i];
      for (int c = 0; c < 3; ++c)
        EXPECT_FLOAT_EQ(named(all, "error").image.at(x, y)[c], float(std::sqrt(variance[c])));
    }
}

TEST(Layers, BandsOfRowsHaveTheBitsOfTheWhole) {
  const Film film = random_film();
  const std::vector<ImageLayer> whole = develop_layers(film);
  for (const int step : {1, 2, 3, film.height}) {
    for (int y0 = 0; y0 < film.height; y0 += step) {
      const int y1 = std::min(y0 + step, film.height);
      const std::vector<ImageLayer> band = develop_layers(film, y0, y1, [](const std::string&) { return true; });
      ASSERT_EQ(band.size(), whole.size());
      for (size_t l = 0; l < band.size(); ++l) {
        ASSERT_EQ(band[l].image.height, y1 - y0);
        const Image& all = whole[l].image;
        const std::vector<float> meant(all.at(0, y0), all.at(0, y0) + band[l].image.pixels.size());
        EXPECT_EQ(band[l].image.pixels, meant) << whole[l].name << " from row " << y0;
      }
    }
  }
  const auto only_p = [](const std::string& name) { return name == "P"; };
  const std::vector<ImageLayer> chosen = develop_layers(film, 0, 1, only_p);
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[1].name, "P");
}

TEST(Layers, BeautyComesFirstWithAlphaAndAFilmWithoutLayersHasOnlyErrorAndSamplesBeside) {
  Film film(2, 1, false);
  film.pixels[0] = pixel_of({Color(2), Color(4)});
  film.pixels[0].coverage = {1, 0, 0, 0};
  const std::vector<ImageLayer> all = develop_layers(film);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "");
  EXPECT_TRUE(all[0].half);
  EXPECT_EQ(all[0].image.at(0, 0)[0], 3);
  EXPECT_EQ(all[0].image.at(0, 0)[3], 0.5f);
  EXPECT_EQ(all[0].image.at(1, 0)[3], 0);
  EXPECT_EQ(all[1].name, "error");
  EXPECT_EQ(all[2].name, "samples");
}

TEST(Composite, PutsTheGroundWhereThePictureIsOpen) {
  Image beauty(2, 1, 4);
  const float values[] = {1, 2, 3, 1, 0.5f, 0.25f, 0, 0.5f};
  std::copy(std::begin(values), std::end(values), beauty.pixels.begin());
  const Image out = composite(beauty, Color(10, 20, 40));
  EXPECT_EQ(out.at(0, 0)[2], 3);
  EXPECT_EQ(out.at(1, 0)[0], 5.5f);
  EXPECT_EQ(out.at(1, 0)[2], 20);
}

}  // namespace
}  // namespace sateen
