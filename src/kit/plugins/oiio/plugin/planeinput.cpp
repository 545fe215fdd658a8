/* Plane files for every program built on OpenImageIO: a reader plug-in, plane.imageio.so.
 *
 * A plane has no pixels. It is drawn at the size of the hints "plane:width" and "plane:height"; one
 * of them keeps the frame's shape, and without any a unit is a pixel. "plane:frame" is the frame of
 * a film, from 1. Programs that give no hints can have them in the name: x.plane?plane:width=4096.
 * Linear light, premultiplied.
 *
 * The file is read and verified as a whole when it is opened. Rows are drawn downwards; any other
 * part begins a drawer of its own, which costs what borders the part has.
 */
#include <planefile.h>

#include <climits>
#include <cmath>
#include <map>

#include "plugins/oiio/plugin/partinput.h"

namespace {

using OIIO::ImageSpec;

class PlaneInput final : public PartInput {
public:
  ~PlaneInput() override { close(); }
  const char *format_name() const override { return "plane"; }
  bool valid_file(const std::string &name) const override {
    return begins(name, PLANEFILE_MAGIC_BYTES, planefile_is);
  }
  using PartInput::open;
  bool open(const std::string &name, ImageSpec &spec, const ImageSpec &config) override;
  bool close() override;

protected:
  bool is_open() const override { return plane_; }
  bool read_part(const Part &part, void *data, size_t stride) override;

private:
  bool create_plane(const ImageSpec &hints);
  bool choose_size(const ImageSpec &hints);
  bool begin(const Part &part);
  bool read_row(float *out);

  planefile_plane *plane_ = nullptr;
  planefile_drawer *drawer_ = nullptr;
  Part next_ = {}; /* what the drawer draws: its columns, and its next row */
};

/* Removes the hints after a question mark from a name, unless a file has the whole name. */
void take_hints(std::string &name, ImageSpec &hints) {
  std::map<std::string, std::string> given;
  std::string file;
  if (OIIO::Filesystem::exists(name) || !OIIO::Strutil::get_rest_arguments(name, file, given))
    return;
  for (const auto &hint : given)
    hints.attribute(hint.first, hint.second);
  name = file;
}

/* 0: there is no such hint; below 0: it is not a number from 1 on. */
int count_hint(const ImageSpec &hints, const char *name) {
  const OIIO::ParamValue *hint = hints.find_attribute(name);
  int side = hint ? hint->get_int(0) : 0;
  return side > 0 || !hint ? side : -1;
}

bool PlaneInput::choose_size(const ImageSpec &hints) {
  const planefile_info info = planefile_plane_info(plane_);
  const char *const names[] = {"plane:width", "plane:height"};
  const double units[] = {info.width, info.height};
  const int hinted[] = {count_hint(hints, names[0]), count_hint(hints, names[1])};
  uint32_t sides[2];
  for (int i = 0; i < 2; i++) {
    int other = hinted[1 - i];
    double shaped = units[i] * (other > 0 ? other / units[1 - i] : 1);
    double side = hinted[i] != 0 ? hinted[i] : std::floor(shaped + 0.5);
    if (hinted[i] < 0 || !(side <= INT_MAX)) {
      errorf("%s must be 1 to %d pixels", names[i], INT_MAX);
      return false;
    }
    sides[i] = std::max(uint32_t(side), 1u);
  }
  return describe(sides[0], sides[1], OIIO::TypeDesc::FLOAT, "Linear");
}

bool PlaneInput::create_plane(const ImageSpec &hints) {
  int number = count_hint(hints, "plane:frame");
  uint32_t frame = number > 0 ? uint32_t(number) - 1 : number < 0 ? UINT32_MAX : 0;
  planefile_source bytes = source<planefile_source>();
  planefile_fault fault;
  planefile_status status = planefile_read_frame(&bytes, frame, 0, PLANEFILE_SIDE, &plane_, &fault);
  if (status != PLANEFILE_BAD_ARGUMENT)
    return status == PLANEFILE_OK || refuse(fault);
  errorf("plane:frame must be the number of a frame in the file, from 1");
  return false;
}

bool PlaneInput::open(const std::string &name, ImageSpec &spec, const ImageSpec &config) {
  std::string file = name;
  ImageSpec hints = config;
  close();
  take_hints(file, hints);
  if (!open_bytes(file, hints))
    return false;
  return finish(create_plane(hints) && choose_size(hints), spec);
}

bool PlaneInput::close() {
  planefile_drawer_destroy(drawer_);
  planefile_plane_destroy(plane_);
  drawer_ = nullptr;
  plane_ = nullptr;
  ioproxy_clear();
  return true;
}

/* Begins a drawer whose next row is the first one of the part; it can continue to the last row of
 * the picture. */
bool PlaneInput::begin(const Part &part) {
  if (drawer_ && next_.x == part.x && next_.y == part.y && next_.columns == part.columns)
    return true;
  planefile_drawer_destroy(drawer_);
  drawer_ = nullptr;
  next_ = part;
  planefile_view view = {};
  view.width = uint32_t(m_spec.width);
  view.height = uint32_t(m_spec.height);
  view.x = uint32_t(part.x);
  view.y = uint32_t(part.y);
  view.columns = uint32_t(part.columns);
  view.rows = view.height - view.y;
  view.sampling = PLANEFILE_AREA;
  return planefile_drawer_create(plane_, &view, &drawer_) == PLANEFILE_OK;
}

bool PlaneInput::read_row(float *out) {
  const planefile_span *spans;
  size_t count;
  if (planefile_drawer_row(drawer_, &spans, &count) != PLANEFILE_OK)
    return false;
  uint32_t x = 0;
  for (size_t i = 0; i < count; i++)
    for (; x < spans[i].end; x++)
      for (int32_t channel : spans[i].colour.colour)
        *out++ = float(channel) / PLANEFILE_WHITE;
  next_.y++;
  return true;
}

bool PlaneInput::read_part(const Part &part, void *data, size_t stride) {
  bool is_drawn = begin(part);
  for (int row = 0; is_drawn && row < part.rows; row++)
    is_drawn =
        read_row(reinterpret_cast<float *>(static_cast<char *>(data) + size_t(row) * stride));
  if (is_drawn)
    return true;
  /* No other failure is possible for a plane that was verified. */
  errorf("no memory for row %d", next_.y);
  planefile_drawer_destroy(drawer_);
  drawer_ = nullptr;
  return false;
}

} // namespace

PART_INPUT_PLUGIN(plane, PlaneInput)
