/* Shared by the module's files: sentences for failures, and the fence around the library.
 *
 *   core --table--> fence( work: our code and the library ) --status and sentence--> core
 *
 * INVARIANT: every function of the table runs inside fence(), so no exception leaves the module.
 */
#pragma once

#include <OpenImageIO/imageio.h>

#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "inside/pictures.h"

struct Failure : std::exception {
  celspan_status status;
  std::string text;
  Failure(celspan_status s, std::string t) : status(s), text(std::move(t)) {}
  const char *what() const noexcept override { return text.c_str(); }
};

/* Runs `work`; an exception becomes a status and a sentence. other: the status for exceptions of
 * the library. */
template <typename Work>
celspan_status fence(cs_picture_failure *failure, celspan_status other, const std::string &name,
                     Work work) noexcept {
  const char *text = "the picture library failed";
  celspan_status status = other;
  try {
    try {
      work();
      return CELSPAN_OK;
    } catch (const Failure &e) {
      failure->status = e.status;
      snprintf(failure->text, sizeof failure->text, "%s: %s", name.c_str(), e.text.c_str());
      return e.status;
    } catch (const std::bad_alloc &) {
      status = CELSPAN_NO_MEMORY;
      text = "out of memory";
    } catch (const std::system_error &e) {
      bool is_starved = e.code() == std::errc::resource_unavailable_try_again;
      status = is_starved ? CELSPAN_NO_MEMORY : other;
      failure->status = status;
      snprintf(failure->text, sizeof failure->text, "%s: %s%s", name.c_str(),
               is_starved ? "the system allows no more threads: " : "", e.what());
      return status;
    } catch (const std::exception &e) {
      failure->status = other;
      snprintf(failure->text, sizeof failure->text, "%s: %s", name.c_str(), e.what());
      return other;
    }
  } catch (...) {
  }
  failure->status = status;
  snprintf(failure->text, sizeof failure->text, "%s: %s", name.c_str(), text);
  return status;
}

/* The library's settings, made once: no threads of its own, no plug-ins from outside. */
void prepare_library();

/* Sets whether a lack of memory is noted from now on. A function of the table. */
void watch_memory();
/* Throws std::bad_alloc if memory has run out since the last call. Must be called before results
 * are returned, because libraries catch the exception and continue. */
void check_memory();

/* The first line of a message of the library, without trailing blanks and full stop. */
std::string first_line(const std::string &message);

celspan_status open_reader(const cs_picture_request *request, cs_picture_reader **out,
                           cs_picture_header *header, cs_picture_failure *failure);
celspan_status read_reader(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                           int32_t height, float *rgba, cs_picture_failure *failure);
celspan_status list_reader(cs_picture_reader *reader,
                           bool (*put)(void *user, const cs_picture_part *part), void *user,
                           cs_picture_failure *failure);
void close_reader(cs_picture_reader *reader);
celspan_status open_writer(const cs_picture_output *output, cs_picture_writer **out,
                           cs_picture_failure *failure);
celspan_status write_writer(cs_picture_writer *writer, int32_t y, int32_t count, const void *rows,
                            cs_picture_failure *failure);
celspan_status close_writer(cs_picture_writer *writer, cs_picture_failure *failure);
void abandon_writer(cs_picture_writer *writer);
