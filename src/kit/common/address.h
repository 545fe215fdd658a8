/* Addresses that contain a file: the pictures of drawings, and the sounds of films.
 *
 *   data:image/png;base64,iVBORw0KGgo...     bytes by base64
 *   data:image/svg+xml,%3Csvg xmlns=...      bytes unchanged, and by per cents
 *
 * The first bytes determine the format: the type before the comma is often wrong.
 */
#pragma once

#include "inside/context.h"

typedef struct cs_address_data {
  unsigned char *bytes;
  size_t size, capacity;
} cs_address_data;

bool cs_address_is_data(const char *address);
/* The bytes of a data: address. *is_broken: it has no comma, or invalid base64. *out must be
 * finished even after a failure. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_address_read(celspan_context *context, const char *address,
                                               cs_address_data *out, bool *is_broken);
void cs_address_finish(cs_address_data *data, celspan_context *context);
/* Writes an address that contains these bytes, of the size that cs_address_encoded_size returns,
 * and without an end of text. */
size_t cs_address_encoded_size(size_t size);
void cs_address_encode(const unsigned char *bytes, size_t size, char *out);
/* Writes the digits of base64 for bytes, 4 for each 3 of them, filled up by "=". */
void cs_address_digits(const unsigned char *bytes, size_t size, char *out);
/* The byte that an escape such as "%41" means; -1 where text does not begin with one. */
int cs_address_unescape(const char *text);
/* Makes a file without a name, in memory, that contains these bytes, for libraries and programs
 * that read files only. Returns its descriptor; -1, and errno: it cannot be made. */
int cs_address_file(const unsigned char *bytes, size_t size);
