/* The table of functions that the core finds in this module, and the settings of the library. */
#include <atomic>
#include <cerrno>
#include <mutex>

#include "plugins/oiio/shared.h"

namespace {

std::atomic<bool> is_watched{false}, has_run_out{false};

[[noreturn]] void note_lack() {
  has_run_out = true;
  throw std::bad_alloc();
}

} // namespace

void watch_memory() {
  is_watched = true;
  std::set_new_handler(note_lack);
}

/* The C libraries report a lack of memory only by errno. */
void check_memory() {
  if (is_watched && (has_run_out.exchange(false) || errno == ENOMEM))
    throw std::bad_alloc();
}

void prepare_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    OIIO::attribute("plugin_searchpath", "");
    /* celspan has limits of its own; those of the library would refuse large pictures that are read
     * in strips. */
    OIIO::attribute("limits:imagesize_MB", 0);
    OIIO::attribute("limits:channels", CS_PICTURE_CHANNELS);
  });
}

std::string first_line(const std::string &message) {
  std::string line = message.substr(0, message.find('\n'));
  while (!line.empty() && (line.back() == ' ' || line.back() == '\r' || line.back() == '.'))
    line.pop_back();
  return line.empty() ? "no reason was given" : line;
}

const void *celspan_picture_module(void) {
  static const cs_picture_module table = {CS_PICTURE_MODULE_VERSION,
                                          open_reader,
                                          read_reader,
                                          close_reader,
                                          list_reader,
                                          open_writer,
                                          write_writer,
                                          close_writer,
                                          abandon_writer,
                                          watch_memory};
  return &table;
}
