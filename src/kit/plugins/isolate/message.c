#include "plugins/isolate/message.h"

#include <errno.h>
#include <stddef.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "inside/clock.h"

enum { PAUSE_NANOSECONDS = 10000000 };

#define HEAD offsetof(cs_message, text)

typedef union control_data {
  struct cmsghdr align;
  char bytes[CMSG_SPACE(sizeof(int))];
} control_data;

/* ---------------------------------------------------------------- sending */

bool cs_message_send(int socket, const cs_message *message, int descriptor) {
  control_data control = {.bytes = {0}};
  struct iovec bytes = {(void *)(uintptr_t)message, HEAD + strlen(message->text) + 1};
  struct msghdr header = {.msg_iov = &bytes, .msg_iovlen = 1};
  if (descriptor >= 0) {
    header.msg_control = &control;
    header.msg_controllen = sizeof control;
    struct cmsghdr *enclosed = CMSG_FIRSTHDR(&header);
    enclosed->cmsg_level = SOL_SOCKET;
    enclosed->cmsg_type = SCM_RIGHTS;
    enclosed->cmsg_len = CMSG_LEN(sizeof descriptor);
    memcpy(CMSG_DATA(enclosed), &descriptor, sizeof descriptor);
  }
  ssize_t sent;
  do
    sent = sendmsg(socket, &header, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent >= 0;
}

static int enclosed_descriptor(struct msghdr *header) {
  int descriptor = -1;
  struct cmsghdr *enclosed = CMSG_FIRSTHDR(header);
  if (enclosed && enclosed->cmsg_level == SOL_SOCKET && enclosed->cmsg_type == SCM_RIGHTS &&
      enclosed->cmsg_len == CMSG_LEN(sizeof descriptor))
    memcpy(&descriptor, CMSG_DATA(enclosed), sizeof descriptor);
  return descriptor;
}

cs_message_arrival cs_message_receive(int socket, cs_message *out, int *descriptor) {
  control_data control;
  struct iovec bytes = {out, sizeof *out};
  struct msghdr header = {.msg_iov = &bytes, .msg_iovlen = 1};
  if (descriptor) {
    header.msg_control = &control;
    header.msg_controllen = sizeof control;
  }
  ssize_t got = recvmsg(socket, &header, MSG_CMSG_CLOEXEC);
  if (got < 0 && (errno == EINTR || errno == EAGAIN))
    return CS_MESSAGE_LATE;
  if (descriptor)
    *descriptor = got < 0 ? -1 : enclosed_descriptor(&header);
  if (got > (ssize_t)HEAD && memchr(out->text, 0, (size_t)got - HEAD) &&
      out->status >= CELSPAN_OK && out->status <= CELSPAN_INTERNAL)
    return CS_MESSAGE_ARRIVED;
  if (descriptor && *descriptor >= 0)
    close(*descriptor);
  return got > 0 ? CS_MESSAGE_BAD : CS_MESSAGE_OVER;
}

/* A blocking socket returns EAGAIN only if there is a problem with it or with the system. */
cs_message_arrival cs_message_wait(int socket, double patience, cs_message *out, int *descriptor) {
  const struct timespec pause = {.tv_nsec = PAUSE_NANOSECONDS};
  double begun = cs_clock_seconds();
  for (;;) {
    errno = 0;
    cs_message_arrival arrival = cs_message_receive(socket, out, descriptor);
    if (arrival != CS_MESSAGE_LATE)
      return arrival;
    if (errno == EINTR)
      begun = cs_clock_seconds();
    else if (cs_clock_seconds() - begun > patience)
      return CS_MESSAGE_OVER;
    else
      nanosleep(&pause, NULL);
  }
}

/* ---------------------------------------------------------------- headers and parts */

void cs_message_set_header(cs_message *message, const cs_picture_header *header) {
  message->header = (cs_message_header){.width = header->info.width,
                                        .height = header->info.height,
                                        .channels = header->info.channels,
                                        .bits = header->bits,
                                        .dpi = header->dpi,
                                        .alpha = (int32_t)header->alpha,
                                        .has_alpha = header->info.has_alpha,
                                        .is_float = header->info.is_float,
                                        .is_linear = header->is_linear,
                                        .is_turned = header->is_turned,
                                        .is_whole = header->is_whole,
                                        .is_sequential = header->is_sequential,
                                        .names_colour = header->names_colour,
                                        .has_primaries = header->has_primaries,
                                        .file_size = header->file_size,
                                        .file_time = header->file_time,
                                        .file_number = header->file_number};
  memcpy(message->header.format, header->info.format, sizeof message->header.format);
  memcpy(message->header.colour, header->info.colour, sizeof message->header.colour);
  memcpy(message->header.primaries, header->primaries, sizeof message->header.primaries);
  memcpy(message->header.space, header->space, sizeof message->header.space);
  memcpy(message->header.profile, header->profile, sizeof message->header.profile);
}

static bool is_between(int32_t number, int32_t least, int32_t most) {
  return number >= least && number <= most;
}

/* Whether the text is printable and terminated. */
static bool is_name(const char text[16]) {
  const char *end = memchr(text, 0, 16);
  for (const char *at = text; end && at < end; at++)
    if (*at <= ' ' || *at > '~')
      return false;
  return end;
}

bool cs_message_header_of(const cs_message *message, cs_picture_header *out) {
  const cs_message_header *from = &message->header;
  if (!is_between(from->width, 1, CS_PICTURE_SIDE) ||
      !is_between(from->height, 1, CS_PICTURE_SIDE) ||
      !is_between(from->channels, 1, CS_PICTURE_CHANNELS) || !is_between(from->bits, 0, 16) ||
      !is_between(from->alpha, CS_PICTURE_ALPHA_STRAIGHT, CS_PICTURE_ALPHA_CODED) ||
      !is_name(from->format) || !is_name(from->colour) ||
      !memchr(from->space, 0, sizeof from->space) ||
      !memchr(from->profile, 0, sizeof from->profile))
    return false;
  *out = (cs_picture_header){.info = {.width = from->width,
                                      .height = from->height,
                                      .channels = from->channels,
                                      .has_alpha = from->has_alpha != 0,
                                      .is_float = from->is_float != 0},
                             .alpha = (cs_picture_alpha)from->alpha,
                             .bits = from->bits,
                             .dpi = from->dpi > 0 && from->dpi < 1e6 ? from->dpi : 0,
                             .is_linear = from->is_linear != 0,
                             .is_turned = from->is_turned != 0,
                             .is_whole = from->is_whole != 0,
                             .is_sequential = from->is_sequential != 0,
                             .names_colour = from->names_colour != 0,
                             .has_primaries = from->has_primaries != 0,
                             .file_size = from->file_size,
                             .file_time = from->file_time,
                             .file_number = from->file_number};
  memcpy(out->info.format, from->format, sizeof from->format);
  memcpy(out->info.colour, from->colour, sizeof from->colour);
  memcpy(out->primaries, from->primaries, sizeof from->primaries);
  memcpy(out->space, from->space, sizeof from->space);
  memcpy(out->profile, from->profile, sizeof from->profile);
  return true;
}

cs_picture_part cs_message_part_of(const cs_message *message) {
  cs_picture_part part = message->part;
  part.name[sizeof part.name - 1] = '\0';
  part.depth[sizeof part.depth - 1] = '\0';
  return part;
}
