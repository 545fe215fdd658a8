/* The messages between the program, the zygote and the workers, and how they are sent.
 *
 *   program --START, END--------------------> zygote      (one socket; zygote.h)
 *   program --OPEN, READ, ... ROWS, ...-----> worker      (a socket for each; worker_loop.h)
 *           <--PART or PUT, answered--------'
 *           <--DONE-------------------------'
 *
 *   shared memory of a worker:   0                      CS_SHARED_PUT        CS_SHARED
 *                                | texts of a request,  | bytes of the file  |
 *                                | pixels or rows, or   | that is written,   |
 *                                | a colour profile     | or a table         |
 *
 * INVARIANT: a malicious picture may have taken over a worker. So nothing from a worker is trusted:
 * numbers and texts are checked when they arrive, descriptors are not accepted, pixels are copied
 * before they are used, and the size of the shared memory cannot be changed.
 */
#pragma once

#include "readers/layered/profile_table.h"

#define CS_SHARED ((size_t)64 << 20)
#define CS_SHARED_PUT ((size_t)32 << 20)

typedef enum cs_message_kind {
  CS_MESSAGE_START = 1, /* to the zygote, with a descriptor: fork a worker */
  CS_MESSAGE_END,       /* to the zygote: end a worker; answered with how it ended */
  /* with the file as descriptor; in shared memory: the layer, then the space. For a worker that
   * runs ffmpeg, `text` is the format's name there */
  CS_MESSAGE_OPEN,
  CS_MESSAGE_READ,
  CS_MESSAGE_LIST,
  CS_MESSAGE_CLOSE, /* not answered */
  CS_MESSAGE_WRITE, /* in shared memory: name, format, colour, title, names of channels */
  CS_MESSAGE_ROWS,
  CS_MESSAGE_COMPLETE,
  CS_MESSAGE_PROFILE, /* in shared memory: the profile; the answer puts the table there */
  CS_MESSAGE_DONE,    /* the last answer: its status is the outcome, `text` the sentence */
  CS_MESSAGE_PART,    /* a part of the answer to LIST; it is answered by a status, OK: continue */
  CS_MESSAGE_PUT /* a part of the answer to WRITE, ROWS and COMPLETE; answered in the same way */
} cs_message_kind;

typedef enum cs_worker_task {
  CS_WORKER_READS = 0, /* pictures, through the picture module */
  /* one picture, also through the picture module; the only limit is for loading */
  CS_WORKER_WRITES,
  CS_WORKER_SAMPLES, /* colour profiles, through the colour module */
  /* the rest each have one file, and run ffmpeg: to decode a sound, */
  CS_WORKER_LISTENS,
  CS_WORKER_LISTS,  /* to list the pictures of a movie (ffprobe), */
  CS_WORKER_WATCHES /* and to decode these */
} cs_worker_task;

/* The message that brings the shared memory, or the pipe for what ffmpeg writes. */
typedef struct cs_message_start {
  uint64_t memory; /* the most bytes that the worker may allocate after its start; 0: any */
  double loading;  /* the most seconds for loading the module; 0: any */
  int32_t task;    /* cs_worker_task */
} cs_message_start;

typedef struct cs_message_open {
  int32_t subimage, has_layer, has_space;
} cs_message_open;

/* The form of the samples; 0: the form in the file. */
typedef struct cs_message_sound {
  int32_t rate, channels;
  double speed; /* 1: the original speed */
} cs_message_sound;

/* Which pictures of a movie are decoded, and how. */
typedef struct cs_message_movie {
  double from; /* seconds, by the times of the file: where decoding begins, if has_from is set */
  int32_t has_from, width, height;
  int32_t is_careful; /* what is damaged looks the same each time, which takes one thread */
  char pixels[16], decoder[16]; /* names of ffmpeg; decoder "": the usual one */
} cs_message_movie;

/* cs_colour_request without its bytes. */
typedef struct cs_message_profile {
  uint64_t size; /* 0: no profile */
  uint32_t power, places[8];
  int32_t has_places;
} cs_message_profile;

/* cs_picture_header, with numbers instead of bool and enum, because C restricts the values of
 * these. */
typedef struct cs_message_header {
  int32_t width, height, channels, bits, alpha;
  int32_t has_alpha, is_float, is_linear, is_turned, is_whole, is_sequential;
  int64_t file_size, file_time;
  uint64_t file_number;
  double dpi;
  int32_t names_colour, has_primaries;
  float primaries[8];
  char format[16], colour[16], space[CS_PICTURE_SPACE], profile[CS_PICTURE_SPACE];
} cs_message_header;

/* cs_picture_output without its texts. */
typedef struct cs_message_output {
  int32_t width, height, channels, depth, bits, is_straight, frame, has_title, has_names;
  int32_t has_primaries;
  float primaries[8];
  char software[CS_PICTURE_SOFTWARE];
  double frames_second;
  cs_picture_moving moving;
} cs_message_output;

typedef struct cs_message {
  int32_t kind, status; /* a celspan_status */
  uint32_t number;      /* the number of the worker in the zygote, or of the reader in the worker */
  union {
    cs_message_start start;
    cs_message_open open;
    cs_message_sound sound;
    cs_message_movie movie;
    celspan_rectangle rectangle;
    cs_message_header header;
    cs_picture_part part;
    cs_message_output output;
    cs_message_profile profile;
    struct {
      int32_t first, count;
    } rows;
    struct {
      uint64_t offset, size;
    } put;
    int32_t ending; /* as waitpid returns it */
  };
  char text[sizeof((cs_picture_failure *)0)->text]; /* sent up to its end */
} cs_message;

#define CS_MESSAGE_PATIENCE 5.0

typedef enum cs_message_arrival {
  CS_MESSAGE_ARRIVED,
  CS_MESSAGE_LATE, /* nothing arrived in time, or a signal arrived first */
  CS_MESSAGE_OVER, /* the other side has ended */
  CS_MESSAGE_BAD   /* the other side violates the protocol */
} cs_message_arrival;

/* descriptor: sent with the message; the caller still owns it; -1: none. false: the other side has
 * ended. */
bool cs_message_send(int socket, const cs_message *message, int descriptor);
/* *descriptor: the descriptor that was sent with the message, or -1; descriptor NULL: none is
 * accepted. */
cs_message_arrival cs_message_receive(int socket, cs_message *out, int *descriptor);
/* The same on a blocking socket, without LATE: if it has only returned EAGAIN for `patience`
 * seconds, the other side counts as ended. */
cs_message_arrival cs_message_wait(int socket, double patience, cs_message *out, int *descriptor);

void cs_message_set_header(cs_message *message, const cs_picture_header *header);
/* false: the header is invalid. */
bool cs_message_header_of(const cs_message *message, cs_picture_header *out);
/* The part in a message PART, with terminated texts. */
cs_picture_part cs_message_part_of(const cs_message *message);
