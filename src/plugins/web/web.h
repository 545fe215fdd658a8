/* What the files of the web module share.
 *
 *   connection: reading --whole--> waiting --answer--> sending --sent--> reading
 *                  \--too slow, or its place is taken--> closing    \--too slow--> closing
 */
#pragma once

#include <microhttpd.h>
#include <time.h>

#include "plugins/web/module.h"

typedef enum web_state { WEB_READING, WEB_WAITING, WEB_SENDING, WEB_CLOSING } web_state;

typedef struct web_connection {
  struct web_connection *next, *previous;
  int socket; /* borrowed from the library */
  web_state state;
  double since; /* the state */
} web_connection;

typedef struct web_request {
  struct web_request *next;       /* of all that are not finished */
  struct MHD_Connection *library; /* the library's name for the connection */
  web_connection *connection;     /* borrowed */
  cs_web_request whole;           /* the request as the program gets it */
  bool has_begun, is_long, is_taken, is_answered;
  char body[CS_WEB_BODY];
  char target[]; /* as it was sent */
} web_request;

struct cs_web {
  struct MHD_Daemon *daemon;
  web_connection *connections; /* newest first */
  web_request *requests;       /* newest first */
  uint64_t last_id;
  cs_web_counts counts;
};

/* Seconds since some moment, which never go back. */
static inline double web_now(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static inline void web_enter(web_connection *connection, web_state state) {
  if (connection->state == WEB_CLOSING)
    return;
  connection->state = state;
  connection->since = web_now();
}

/* Callbacks of the library. */
enum MHD_Result web_admit(void *web, const struct sockaddr *from, socklen_t size);
void web_notify(void *web, struct MHD_Connection *library, void **context,
                enum MHD_ConnectionNotificationCode code);
/* Closes connections that are too slow. Returns the milliseconds until the next connection may be
 * too slow; -1: none can be. */
int web_sweep(cs_web *web);
