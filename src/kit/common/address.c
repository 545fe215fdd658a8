#include "common/address.h"

#include <string.h>
#include <strings.h>
#include <sys/mman.h>

#include "inside/files.h"
#include "inside/number.h"

#define PREFIX "data:;base64,"
#define PREFIX_SIZE (sizeof PREFIX - 1)

/* ---------------------------------------------------------------- codes */

int cs_address_unescape(const char *text) {
  int high = text[0] == '%' ? cs_hex_digit(text[1]) : -1;
  int low = high >= 0 ? cs_hex_digit(text[2]) : -1;
  return low >= 0 ? 16 * high + low : -1;
}

/* Reads the next byte of a URI; an escape such as %41 is one byte. */
static unsigned char take_byte(const char **text) {
  int escaped = cs_address_unescape(*text);
  unsigned char byte = escaped >= 0 ? (unsigned char)escaped : (unsigned char)**text;
  *text += escaped >= 0 ? 3 : 1;
  return byte;
}

/* -1 for a character that is not a digit of base64. */
static int base64_digit(unsigned char c) {
  if (c >= 'A' && c <= 'Z')
    return c - 'A';
  if (c >= 'a' && c <= 'z')
    return c - 'a' + 26;
  if (c >= '0' && c <= '9')
    return c - '0' + 52;
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

/* Source: RFC 4648, 4. Space is skipped, and "=" ends the data. A digit that is left over has not
 * the bits of a byte. out has room for three quarters of the text. */
static bool decode_base64(const char *text, cs_address_data *out) {
  uint32_t bits = 0;
  int count = 0;
  while (*text) {
    unsigned char c = take_byte(&text);
    int digit = base64_digit(c);
    if (c == '=')
      break;
    if (digit < 0 && (!c || !strchr(" \t\n\r\f", c)))
      return false;
    if (digit < 0)
      continue;
    bits = bits << 6 | (uint32_t)digit;
    count += 6;
    if (count >= 8) {
      count -= 8;
      out->bytes[out->size++] = (unsigned char)(bits >> count);
    }
  }
  return count != 6;
}

size_t cs_address_encoded_size(size_t size) { return PREFIX_SIZE + (size + 2) / 3 * 4; }

void cs_address_encode(const unsigned char *bytes, size_t size, char *out) {
  memcpy(out, PREFIX, PREFIX_SIZE);
  cs_address_digits(bytes, size, out + PREFIX_SIZE);
}

void cs_address_digits(const unsigned char *bytes, size_t size, char *out) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t at = 0; at < size; at += 3, out += 4) {
    size_t rest = size - at;
    uint32_t bits = (uint32_t)bytes[at] << 16 | (rest > 1 ? (uint32_t)bytes[at + 1] << 8 : 0) |
                    (rest > 2 ? bytes[at + 2] : 0);
    for (int i = 0; i < 4; i++)
      out[i] = i > 0 && (size_t)i > rest ? '=' : digits[bits >> (18 - 6 * i) & 63];
  }
}

/* ---------------------------------------------------------------- addresses */

bool cs_address_is_data(const char *address) { return strncasecmp(address, "data:", 5) == 0; }

celspan_status cs_address_read(celspan_context *context, const char *address, cs_address_data *out,
                               bool *is_broken) {
  static const char mark[] = ";base64";
  const size_t mark_size = sizeof mark - 1;
  *out = (cs_address_data){NULL, 0, 0};
  const char *comma = strchr(address, ',');
  *is_broken = !comma;
  if (!comma)
    return CELSPAN_OK;
  const char *text = comma + 1;
  while (comma > address && comma[-1] == ' ')
    comma--;
  bool is_coded = (size_t)(comma - address) >= mark_size &&
                  strncasecmp(comma - mark_size, mark, mark_size) == 0;
  out->capacity = strlen(text) + 1;
  out->bytes = cs_mem_resize(context->memory, NULL, 0, out->capacity);
  if (!out->bytes)
    return cs_fail_memory(context);
  if (is_coded)
    *is_broken = !decode_base64(text, out);
  while (!is_coded && *text)
    out->bytes[out->size++] = take_byte(&text);
  return CELSPAN_OK;
}

void cs_address_finish(cs_address_data *data, celspan_context *context) {
  cs_mem_free(context->memory, data->bytes, data->capacity);
  *data = (cs_address_data){NULL, 0, 0};
}

/* ---------------------------------------------------------------- files */

int cs_address_file(const unsigned char *bytes, size_t size) {
  int descriptor = memfd_create("celspan data", MFD_CLOEXEC);
  size_t done = 0;
  while (descriptor >= 0 && done < size) {
    ssize_t count = write(descriptor, bytes + done, size - done);
    if (count < 0 && errno == EINTR)
      continue;
    if (count <= 0) {
      int error = count < 0 ? errno : EIO;
      close(descriptor);
      errno = error;
      return -1;
    }
    done += (size_t)count;
  }
  return descriptor;
}
