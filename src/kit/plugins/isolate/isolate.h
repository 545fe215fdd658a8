/* A picture module and a colour module that work in processes of their own. The program uses them
 * unless it was given --trust.
 *
 *   core --cs_picture_module--> reader.c, isolate.c --+--> worker.c --sockets--> workers
 *        --cs_colour_module---> isolate.c ------------'
 */
#pragma once

#include "plugins/isolate/worker.h"

/* From now on, workers decode the pictures and sample the colour profiles of this context. Nothing
 * is started yet. */
void cs_isolate_begin(celspan_context *context, const cs_worker_limits *limits);
/* Ends all workers and the zygote, after the context was destroyed. */
void cs_isolate_finish(void);
