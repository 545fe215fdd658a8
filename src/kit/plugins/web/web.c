/* Requests: from the callbacks of libmicrohttpd, which come while the daemon runs, to a list that
 * the program takes them from. A connection whose request is whole is suspended until the answer.
 *
 *   connection: reading --whole--> waiting --answer--> sending --sent--> reading
 *                  \--too slow, or its place is taken--> closing    \--too slow--> closing
 */
#include <arpa/inet.h>
#include <errno.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <time.h>

#include "plugins/web/module.h"

enum {
  /* the library's memory for a request; if it needs more, the library answers 431 or 414 */
  POOL = 16384,
  SPARE = 32 /* connections that are being closed */
};

typedef enum web_state { WEB_READING, WEB_WAITING, WEB_SENDING, WEB_CLOSING } web_state;

typedef struct web_connection {
  struct web_connection *next, *previous;
  int socket; /* borrowed from the library */
  web_state state;
  double since; /* the state */
} web_connection;

typedef struct web_request {
  struct web_request *next;       /* in the list of all that are not finished */
  struct MHD_Connection *library; /* the library's name for the connection */
  web_connection *connection;     /* borrowed */
  cs_web_request whole;           /* the request in the form that the program gets */
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

/* Seconds since some moment; the clock never goes back. */
static double now_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static void enter(web_connection *connection, web_state state) {
  if (connection->state == WEB_CLOSING)
    return;
  connection->state = state;
  connection->since = now_seconds();
}

/* ---------------------------------------------------------------- connections */

/* The library notices that the socket has ended, and closes it. */
static void end_connection(web_connection *connection) {
  enter(connection, WEB_CLOSING);
  shutdown(connection->socket, SHUT_RDWR);
}

/* The oldest connection without a complete request: the list is newest first. */
static web_connection *find_oldest(const cs_web *web, size_t *open) {
  web_connection *oldest = NULL;
  *open = 0;
  for (web_connection *one = web->connections; one; one = one->next) {
    *open += one->state != WEB_CLOSING;
    if (one->state == WEB_READING && (!oldest || one->since <= oldest->since))
      oldest = one;
  }
  return oldest;
}

static enum MHD_Result admit(void *user, const struct sockaddr *from, socklen_t size) {
  cs_web *web = user;
  size_t open;
  web_connection *oldest = find_oldest(web, &open);
  (void)from;
  (void)size;
  if (open < CS_WEB_CONNECTIONS)
    return MHD_YES;
  web->counts.displaced += oldest != NULL;
  web->counts.refused += oldest == NULL;
  if (oldest)
    end_connection(oldest);
  return oldest ? MHD_YES : MHD_NO;
}

static void add_connection(cs_web *web, struct MHD_Connection *library, void **context) {
  const union MHD_ConnectionInfo *info =
      MHD_get_connection_info(library, MHD_CONNECTION_INFO_CONNECTION_FD);
  web_connection *added = calloc(1, sizeof *added);
  *context = added;
  if (!added)
    return;
  *added = (web_connection){
      .next = web->connections, .socket = info->connect_fd, .since = now_seconds()};
  if (added->next)
    added->next->previous = added;
  web->connections = added;
}

static void remove_connection(cs_web *web, web_connection *removed) {
  if (removed->next)
    removed->next->previous = removed->previous;
  if (removed->previous)
    removed->previous->next = removed->next;
  else
    web->connections = removed->next;
  free(removed);
}

static void notify(void *user, struct MHD_Connection *library, void **context,
                   enum MHD_ConnectionNotificationCode code) {
  if (code == MHD_CONNECTION_NOTIFY_STARTED)
    add_connection(user, library, context);
  else if (*context)
    remove_connection(user, *context);
}

/* Seconds that a connection may stay in its state; 0: as long as the program needs. */
static double most_seconds(web_state state) {
  return state == WEB_READING ? CS_WEB_IDLE : state == WEB_SENDING ? CS_WEB_SENDING : 0;
}

/* Closes connections that are too slow. Returns the milliseconds until another one may be too slow;
 * -1: this cannot happen. */
static int sweep(cs_web *web) {
  double next = -1, now = now_seconds();
  for (web_connection *one = web->connections; one; one = one->next) {
    double most = most_seconds(one->state), left = one->since + most - now;
    if (most > 0 && left <= 0) {
      web->counts.late++;
      end_connection(one);
    } else if (most > 0 && (next < 0 || left < next)) {
      next = left;
    }
  }
  return next < 0 ? -1 : (int)(next * 1000) + 1;
}

/* ---------------------------------------------------------------- reading */

/* The first callback of a request: its result is the `context` of the next callbacks. */
static void *begin_request(void *user, const char *target, struct MHD_Connection *library) {
  cs_web *web = user;
  size_t size = strlen(target) + 1;
  const union MHD_ConnectionInfo *info =
      MHD_get_connection_info(library, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
  web_request *request = info->socket_context ? calloc(1, sizeof *request + size) : NULL;
  if (!request)
    return NULL;
  memcpy(request->target, target, size);
  request->library = library;
  request->connection = info->socket_context;
  request->next = web->requests;
  web->requests = request;
  return request;
}

/* The headers that are read; each may occur once. */
static const char *const single[] = {MHD_HTTP_HEADER_HOST,
                                     "Origin",
                                     "Sec-Fetch-Site",
                                     CS_WEB_TOKEN,
                                     MHD_HTTP_HEADER_CONTENT_LENGTH,
                                     MHD_HTTP_HEADER_TRANSFER_ENCODING};
enum { SINGLE = sizeof single / sizeof *single };

typedef struct web_head {
  size_t bytes;
  unsigned lines[SINGLE]; /* how often each of these occurs */
} web_head;

static enum MHD_Result count_header(void *user, enum MHD_ValueKind kind, const char *name,
                                    const char *value) {
  web_head *head = user;
  (void)kind;
  head->bytes += strlen(name) + (value ? strlen(value) : 0) + 4;
  for (size_t i = 0; i < SINGLE; i++)
    head->lines[i] += strcasecmp(name, single[i]) == 0;
  return MHD_YES;
}

/* The status with which a request is refused because of its head; 0: it is not refused. */
static unsigned judge_head(const web_request *request) {
  web_head head = {.bytes = strlen(request->target)};
  MHD_get_connection_values(request->library, MHD_HEADER_KIND, count_header, &head);
  if (head.bytes > CS_WEB_HEAD)
    return MHD_HTTP_REQUEST_HEADER_FIELDS_TOO_LARGE;
  for (size_t i = 0; i < SINGLE; i++)
    if (head.lines[i] > 1)
      return MHD_HTTP_BAD_REQUEST;
  return 0;
}

static const char *header(const web_request *request, const char *name) {
  return MHD_lookup_connection_value(request->library, MHD_HEADER_KIND, name);
}

static void complete(cs_web *web, web_request *request, const char *method) {
  web->counts.requests++;
  request->whole.id = ++web->last_id;
  request->whole.method = method;
  request->whole.target = request->target;
  request->whole.host = header(request, MHD_HTTP_HEADER_HOST);
  request->whole.origin = header(request, "Origin");
  request->whole.token = header(request, CS_WEB_TOKEN);
  request->whole.site = header(request, "Sec-Fetch-Site");
  request->whole.body = request->body;
  enter(request->connection, WEB_WAITING);
  MHD_suspend_connection(request->library);
}

/* Answers a request that is not passed to the program at once, and closes its connection. */
static enum MHD_Result refuse(cs_web *web, struct MHD_Connection *library, unsigned status) {
  struct MHD_Response *response =
      MHD_create_response_from_buffer(0, (void *)(size_t) "", MHD_RESPMEM_PERSISTENT);
  web->counts.oversized += status != MHD_HTTP_BAD_REQUEST;
  if (!response)
    return MHD_NO;
  MHD_add_response_header(response, MHD_HTTP_HEADER_CONNECTION, "close");
  enum MHD_Result result = MHD_queue_response(library, status, response);
  MHD_destroy_response(response);
  return result;
}

static void add_body(web_request *request, const char *bytes, size_t size) {
  cs_web_request *whole = &request->whole;
  request->is_long |= size > CS_WEB_BODY - whole->body_size;
  if (request->is_long)
    return;
  memcpy(request->body + whole->body_size, bytes, size);
  whole->body_size += size;
}

/* Called when the head is read, for each part of a body, and at the end without bytes. */
static enum MHD_Result handle(void *user, struct MHD_Connection *library, const char *path,
                              const char *method, const char *http, const char *bytes, size_t *size,
                              void **context) {
  web_request *request = *context;
  (void)path;
  (void)http;
  if (!request)
    return MHD_NO;
  if (request->is_answered)
    return MHD_YES;
  if (!request->has_begun) {
    unsigned status = judge_head(request);
    request->has_begun = true;
    return status ? refuse(user, library, status) : MHD_YES;
  }
  if (*size == 0 && request->is_long)
    return refuse(user, library, MHD_HTTP_CONTENT_TOO_LARGE);
  if (*size == 0)
    complete(user, request, method);
  else
    add_body(request, bytes, *size);
  *size = 0;
  return MHD_YES;
}

static void finish_request(void *user, struct MHD_Connection *library, void **context,
                           enum MHD_RequestTerminationCode code) {
  cs_web *web = user;
  web_request *finished = *context;
  (void)library;
  (void)code;
  for (web_request **at = &web->requests; *at && finished; at = &(*at)->next)
    if (*at == finished) {
      *at = finished->next;
      enter(finished->connection, WEB_READING);
      free(finished);
      break;
    }
  *context = NULL;
}

/* ---------------------------------------------------------------- answering */

/* The oldest request that was not taken: the list is newest first. */
static web_request *find_waiting(const cs_web *web) {
  web_request *oldest = NULL;
  for (web_request *one = web->requests; one; one = one->next)
    if (one->whole.id && !one->is_taken)
      oldest = one;
  return oldest;
}

static const cs_web_request *take(cs_web *web) {
  web_request *oldest = find_waiting(web);
  if (!oldest)
    return NULL;
  oldest->is_taken = true;
  return &oldest->whole;
}

static struct MHD_Response *make_response(const cs_web_answer *answer) {
  struct MHD_Response *response = MHD_create_response_from_buffer(
      answer->size, (void *)(size_t)answer->bytes, MHD_RESPMEM_MUST_COPY);
  bool is_good = response;
  for (size_t i = 0; i < answer->header_count && is_good; i++)
    is_good = MHD_add_response_header(response, answer->headers[i].name,
                                      answer->headers[i].value) == MHD_YES;
  if (response && !is_good)
    MHD_destroy_response(response);
  return is_good ? response : NULL;
}

static bool answer_request(web_request *request, const cs_web_answer *answer) {
  struct MHD_Response *response = make_response(answer);
  bool is_good =
      response && MHD_queue_response(request->library, answer->status, response) == MHD_YES;
  if (response)
    MHD_destroy_response(response);
  request->is_answered = true;
  enter(request->connection, is_good ? WEB_SENDING : WEB_CLOSING);
  if (!is_good)
    shutdown(request->connection->socket, SHUT_RDWR);
  MHD_resume_connection(request->library);
  return is_good;
}

static bool answer(cs_web *web, uint64_t id, const cs_web_answer *answer) {
  for (web_request *one = web->requests; one; one = one->next)
    if (one->whole.id == id && !one->is_answered)
      return answer_request(one, answer);
  return true; /* the client has gone */
}

/* ---------------------------------------------------------------- the server */

static struct MHD_Daemon *start(cs_web *web, const struct sockaddr_in *at) {
  return MHD_start_daemon(
      MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME, 0, admit, web, handle, web, MHD_OPTION_SOCK_ADDR,
      at, MHD_OPTION_CONNECTION_LIMIT, (unsigned)(CS_WEB_CONNECTIONS + SPARE),
      MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)POOL, MHD_OPTION_URI_LOG_CALLBACK, begin_request,
      web, MHD_OPTION_NOTIFY_COMPLETED, finish_request, web, MHD_OPTION_NOTIFY_CONNECTION, notify,
      web, MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_END);
}

static int open_web(uint16_t port, cs_web **out) {
  const struct sockaddr_in at = {
      .sin_family = AF_INET, .sin_port = htons(port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
  cs_web *web = calloc(1, sizeof *web);
  if (!web)
    return ENOMEM;
  errno = 0;
  web->daemon = start(web, &at);
  int error = errno ? errno : ENOMEM;
  *out = web->daemon ? web : NULL;
  if (!web->daemon)
    free(web);
  return *out ? 0 : error;
}

static uint16_t port(const cs_web *web) {
  return MHD_get_daemon_info(web->daemon, MHD_DAEMON_INFO_BIND_PORT)->port;
}

static int descriptor(const cs_web *web) {
  return MHD_get_daemon_info(web->daemon, MHD_DAEMON_INFO_EPOLL_FD)->epoll_fd;
}

static int run(cs_web *web) {
  MHD_UNSIGNED_LONG_LONG library;
  int own = sweep(web);
  MHD_run(web->daemon);
  if (find_waiting(web))
    return 0;
  if (MHD_get_timeout(web->daemon, &library) != MHD_YES)
    return own;
  int wish = library < 60000 ? (int)library : 60000;
  return own < 0 || wish < own ? wish : own;
}

static cs_web_counts counts(const cs_web *web) { return web->counts; }

/* The library requires that no connection is suspended when it stops. */
static void close_web(cs_web *web) {
  if (!web)
    return;
  for (web_request *one = web->requests; one; one = one->next)
    if (one->whole.id && !one->is_answered)
      answer_request(one, &(cs_web_answer){.status = MHD_HTTP_SERVICE_UNAVAILABLE, .bytes = ""});
  MHD_run(web->daemon);
  MHD_stop_daemon(web->daemon);
  while (web->requests) {
    web_request *next = web->requests->next;
    free(web->requests);
    web->requests = next;
  }
  free(web);
}

const void *celspan_web_module(void) {
  static const cs_web_module table = {
      CS_WEB_MODULE_VERSION, open_web, port, descriptor, run, take, answer, counts, close_web};
  return &table;
}
