/* See base/windows/everywhere.h: processes, which there are not, speak to each other by these. */
#pragma once

#include <sys/types.h>

#include <sys/uio.h>

enum { AF_UNIX = 1, SOCK_SEQPACKET = 5, SOCK_CLOEXEC = 0x80000 };
enum { SOL_SOCKET = 1, SCM_RIGHTS = 1, SO_TYPE = 3, SO_RCVTIMEO = 20 };
enum { MSG_NOSIGNAL = 0x4000, MSG_CMSG_CLOEXEC = 0x40000000, MSG_DONTWAIT = 0x40 };
typedef unsigned socklen_t;
struct msghdr {
  struct iovec *msg_iov;
  size_t msg_iovlen, msg_controllen;
  void *msg_control;
};
struct cmsghdr {
  size_t cmsg_len;
  int cmsg_level, cmsg_type;
};
#define CMSG_SPACE(size) (sizeof(struct cmsghdr) + (size))
#define CMSG_LEN(size) CMSG_SPACE(size)
#define CMSG_DATA(header) ((unsigned char *)((header) + 1))
#define CMSG_FIRSTHDR(message) ((struct cmsghdr *)(message)->msg_control)
int socketpair(int family, int kind, int protocol, int ends[2]);
int setsockopt(int socket, int level, int name, const void *value, socklen_t size);
int getsockopt(int socket, int level, int name, void *value, socklen_t *size);
ssize_t recv(int socket, void *bytes, size_t size, int flags);
ssize_t sendmsg(int socket, const struct msghdr *message, int flags);
ssize_t recvmsg(int socket, struct msghdr *message, int flags);
