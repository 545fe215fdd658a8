// OpenCV, one thread.
//
//   opencv blur PICTURE RADIUS ROWS   a Gaussian blur of a picture, which is square: 8-bit RGBA as
//                                     raw bytes. Only the first ROWS of it are blurred and the time
//                                     is scaled up: both passes cost by the row
//   opencv layers FOLDER FIRST LAST   frames of scripts/painted.lua as raw RGBA on standard output,
//                                     in floats: warped, blurred and blended as codes, which saves
//                                     their conversion to light and back
//
// The kernel of a blur reaches twice the radius, as celspan's does.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "measure.h"

namespace {

void soften(const cv::Mat &sharp, cv::Mat &soft, double radius) {
  const int reach = 4 * int(radius) + 1;
  cv::GaussianBlur(sharp, soft, cv::Size(reach, reach), radius / 2, 0, cv::BORDER_REPLICATE);
}

// ---------------------------------------------------------------- a blur

struct Job {
  cv::Mat sharp, soft;
  double radius;
};

void blur(void *user) {
  auto *job = static_cast<Job *>(user);
  soften(job->sharp, job->soft, job->radius);
}

std::vector<unsigned char> read(const char *path) {
  std::vector<unsigned char> bytes;
  std::FILE *file = std::fopen(path, "rb");
  if (!file)
    bench_stop("%s cannot be read", path);
  std::fseek(file, 0, SEEK_END);
  bytes.resize(size_t(std::ftell(file)));
  std::rewind(file);
  if (std::fread(bytes.data(), 1, bytes.size(), file) != bytes.size())
    bench_stop("%s cannot be read", path);
  std::fclose(file);
  return bytes;
}

void measure_blur(char **words) {
  std::vector<unsigned char> bytes = read(words[0]);
  int side = 1;
  while (size_t(side) * size_t(side) * 4 < bytes.size())
    side++;
  const cv::Mat whole(side, side, CV_8UC4, bytes.data());
  const int rows = std::atoi(words[2]);
  Job job{whole.rowRange(0, rows).clone(), cv::Mat(), std::atof(words[1])};
  bench_measure_part(blur, &job, {double(side) / rows, {}});
  bench_line_end();
}

// ---------------------------------------------------------------- painted layers

// The numbers of scripts/painted.lua.
const struct {
  double move, radius;
} layers[] = {{0, 0}, {.05, 12}, {.1, 10}, {.2, 6}, {.3, 0}, {.42, 0}, {.65, 0}, {.8, 0}, {1, 8}};
const int layer_count = 9, film_frames = 48;
const cv::Size frame_size(1280, 720);
const double layer_width = 1760;

// A picture with alpha as premultiplied floats from 0 to 255.
cv::Mat read_layer(const std::string &path) {
  cv::Mat coded = cv::imread(path, cv::IMREAD_UNCHANGED), layer;
  if (coded.type() != CV_8UC4)
    bench_stop("%s is no picture with alpha", path.c_str());
  coded.convertTo(layer, CV_32F);
  for (int y = 0; y < layer.rows; y++) {
    auto *row = layer.ptr<cv::Vec4f>(y);
    for (int x = 0; x < layer.cols; x++)
      for (int c = 0; c < 3; c++)
        row[x][c] *= row[x][3] / 255;
  }
  return layer;
}

void blend(const cv::Mat &front, cv::Mat &frame) {
  for (int y = 0; y < frame.rows; y++) {
    const float *from = front.ptr<float>(y);
    float *to = frame.ptr<float>(y);
    for (int x = 0; x < 4 * frame.cols; x += 4) {
      const float through = 1 - from[x + 3] / 255;
      for (int c = 0; c < 4; c++)
        to[x + c] = from[x + c] + to[x + c] * through;
    }
  }
}

// Moves the layer to its place in the frame, where pixel 0 has its middle at 0.5 in celspan.
void place(const cv::Mat &layer, int number, int index, cv::Mat &out) {
  const double zoom = layer_width / layer.cols;
  const double travel = 40 + 400 * layers[index].move * number / film_frames;
  const double middle = zoom / 2 - .5;
  const cv::Matx23d matrix(zoom, 0, middle - travel, 0, zoom, middle - 135);
  cv::warpAffine(layer, out, matrix, frame_size, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
}

void write_frame(const cv::Mat &frame) {
  cv::Mat coded, ordered;
  frame.convertTo(coded, CV_8U);
  cv::cvtColor(coded, ordered, cv::COLOR_BGRA2RGBA);
  const size_t size = ordered.total() * ordered.elemSize();
  if (std::fwrite(ordered.data, 1, size, stdout) != size)
    bench_stop("a frame cannot be written");
}

void make_layers(char **words) {
  std::vector<cv::Mat> painted;
  for (int i = 1; i <= layer_count; i++)
    painted.push_back(read_layer(std::string(words[0]) + "/" + std::to_string(i) + ".png"));
  cv::Mat frame(frame_size, CV_32FC4), placed, soft;
  for (int number = std::atoi(words[1]); number <= std::atoi(words[2]); number++) {
    frame.setTo(0);
    for (int i = 0; i < layer_count; i++) {
      place(painted[size_t(i)], number - 1, i, placed);
      if (layers[i].radius > 0)
        soften(placed, soft, layers[i].radius);
      blend(layers[i].radius > 0 ? soft : placed, frame);
    }
    write_frame(frame);
  }
}

} // namespace

int main(int argc, char **argv) {
  cv::setNumThreads(1);
  if (argc == 5 && std::strcmp(argv[1], "blur") == 0)
    measure_blur(argv + 2);
  else if (argc == 5 && std::strcmp(argv[1], "layers") == 0)
    make_layers(argv + 2);
  else
    bench_stop("usage: opencv blur PICTURE RADIUS ROWS | layers FOLDER FIRST LAST");
  return 0;
}
