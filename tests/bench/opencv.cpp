// OpenCV's Gaussian blur, one thread: `opencv blur PICTURE RADIUS ROWS`.
//
// The picture is 8-bit RGBA as raw bytes, square. Only the first ROWS of it are blurred and the
// time is scaled up: both passes cost by the row. The kernel reaches twice the radius, as celspan's
// does.
#include <cstdio>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "measure.h"

namespace {

struct Job {
  cv::Mat sharp, soft;
  double radius;
};

void blur(void *user) {
  auto *job = static_cast<Job *>(user);
  const int reach = 4 * int(job->radius) + 1;
  cv::GaussianBlur(job->sharp, job->soft, cv::Size(reach, reach), job->radius / 2, 0,
                   cv::BORDER_REPLICATE);
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

} // namespace

int main(int argc, char **argv) {
  if (argc != 5)
    bench_stop("usage: opencv blur PICTURE RADIUS ROWS");
  cv::setNumThreads(1);
  std::vector<unsigned char> bytes = read(argv[2]);
  int side = 1;
  while (size_t(side) * size_t(side) * 4 < bytes.size())
    side++;
  const cv::Mat whole(side, side, CV_8UC4, bytes.data());
  const int rows = std::atoi(argv[4]);
  Job job{whole.rowRange(0, rows).clone(), cv::Mat(), std::atof(argv[3])};
  bench_measure_part(blur, &job, {double(side) / rows, {}});
  bench_line_end();
}
