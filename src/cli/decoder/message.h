/* What the program, the keeper and the decoders say to each other, and how it travels.
 *
 *   program --START, END--------------------> keeper      (one socket; keeper.h)
 *   program --OPEN, READ, ... ROWS, ...-----> decoder     (a socket for each; server.h)
 *           <--PART or PUT, to be answered--'
 *           <--DONE-------------------------'
 *
 *   shared memory of a decoder:   0                      CS_SHARED_PUT        CS_SHARED
 *                                 | texts of a request,  | bytes of the file  |
 *                                 | pixels or rows       | that is written    |
 *
 * INVARIANT: a decoder may have been taken over by a picture. So nothing that comes from one is
 * believed: numbers and texts are checked on arrival, descriptors are not accepted, pixels are copied
 * before they are used, and the shared memory has a size that cannot be changed.
 */
#ifndef CS_CLI_DECODER_MESSAGE_H
#define CS_CLI_DECODER_MESSAGE_H

#include "pictures/module.h"

#define CS_SHARED ((size_t)64 << 20)
#define CS_SHARED_PUT ((size_t)32 << 20)

typedef enum cs_message_kind {
  CS_MESSAGE_START = 1, /* to the keeper, with shared memory: fork a decoder */
  CS_MESSAGE_END,       /* to the keeper: end a decoder; answered with how it ended */
  CS_MESSAGE_OPEN,      /* with the file; in shared memory: the layer, then the space */
  CS_MESSAGE_READ,
  CS_MESSAGE_LIST,
  CS_MESSAGE_CLOSE, /* not answered */
  CS_MESSAGE_WRITE, /* in shared memory: name, format, title, names of channels */
  CS_MESSAGE_ROWS,
  CS_MESSAGE_COMPLETE,
  CS_MESSAGE_DONE, /* the last answer; its status is the outcome, `text` the sentence */
  CS_MESSAGE_PART, /* of LIST; to be answered by a status, OK: go on */
  CS_MESSAGE_PUT   /* of WRITE, ROWS and COMPLETE; likewise */
} cs_message_kind;

typedef struct cs_message_start {
  uint64_t memory;   /* bytes that the decoder may have beside what it begins with; 0: any */
  double loading;    /* seconds that loading the module may take; 0: any */
  int32_t is_writer; /* a writer in place of a decoder: it has no limits but that */
} cs_message_start;

typedef struct cs_message_open {
  int32_t subimage, has_layer, has_space;
} cs_message_open;

/* cs_picture_header, with numbers in place of what C has rules for. */
typedef struct cs_message_header {
  int32_t width, height, channels, bits, alpha;
  int32_t has_alpha, is_float, is_linear, is_turned, is_whole, is_sequential;
  int64_t file_size, file_time;
  uint64_t file_number;
  char format[16], colour[16];
} cs_message_header;

/* cs_picture_output without its texts. */
typedef struct cs_message_output {
  int32_t width, height, channels, depth, bits, is_straight, transfer, frame, has_title, has_names;
  double frames_second;
} cs_message_output;

typedef struct cs_message {
  int32_t kind, status; /* a celspan_status */
  uint32_t number;      /* of the decoder in the keeper, or of the reader in the decoder */
  union {
    cs_message_start start;
    cs_message_open open;
    celspan_rectangle rectangle;
    cs_message_header header;
    cs_picture_part part;
    cs_message_output output;
    struct {
      int32_t first, count;
    } rows;
    struct {
      uint64_t offset, size;
    } put;
    int32_t ending; /* as waitpid tells it */
  };
  char text[sizeof((cs_picture_failure *)0)->text]; /* what follows its end is not sent */
} cs_message;

typedef enum cs_message_arrival {
  CS_MESSAGE_ARRIVED,
  CS_MESSAGE_LATE, /* nothing came in the time that the socket has, or a signal came first */
  CS_MESSAGE_OVER, /* the other side is gone */
  CS_MESSAGE_BAD   /* the other side does not keep to the rules */
} cs_message_arrival;

/* descriptor: sent along, and stays the caller's; -1: none. false: nobody is there to read it. */
bool cs_message_send(int socket, const cs_message *message, int descriptor);
/* *descriptor: the one sent along, or -1; NULL: none is accepted. */
cs_message_arrival cs_message_receive(int socket, cs_message *out, int *descriptor);

void cs_message_set_header(cs_message *message, const cs_picture_header *header);
/* false: it is none that a picture can have. */
bool cs_message_header_of(const cs_message *message, cs_picture_header *out);
/* The part of a PART, with texts that end. */
cs_picture_part cs_message_part_of(const cs_message *message);

#endif
