/* The command lines of ffmpeg and ffprobe in a worker. */
#pragma once

#include "plugins/isolate/message.h"

enum { CS_MEDIA_ARGUMENTS = 64, CS_MEDIA_ARGUMENT_TEXTS = 1024 };

typedef struct cs_media_arguments {
  const char *list[CS_MEDIA_ARGUMENTS]; /* the program first, NULL at the end */
  size_t count;
  char texts[CS_MEDIA_ARGUMENT_TEXTS]; /* of the arguments that contain numbers */
  size_t size;
} cs_media_arguments;

/* file: the name of the file in the worker. message: its OPEN; it must live as long as *out. */
void cs_media_arguments_make(cs_worker_task task, const cs_message *message, const char *file,
                             cs_media_arguments *out);
