/* Connections: which may stay, and for how long. The bounds are in plugins/web/module.h. */
#include <stdlib.h>
#include <sys/socket.h>

#include "plugins/web/web.h"

/* The library notices that the socket has ended, and closes it. */
static void end_connection(web_connection *connection) {
  web_enter(connection, WEB_CLOSING);
  shutdown(connection->socket, SHUT_RDWR);
}

/* The oldest that has no whole request: the list is newest first. */
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

enum MHD_Result web_admit(void *user, const struct sockaddr *from, socklen_t size) {
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
  *added =
      (web_connection){.next = web->connections, .socket = info->connect_fd, .since = web_now()};
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

void web_notify(void *user, struct MHD_Connection *library, void **context,
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

int web_sweep(cs_web *web) {
  double next = -1, now = web_now();
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
