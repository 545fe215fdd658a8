#include "readers/layered/profile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void set_name(char name[64], const char *text) {
  size_t done = 0;
  for (; done < 63 && text[done]; done++)
    name[done] = text[done] >= ' ' && text[done] < 127 ? text[done] : '?';
  name[done] = 0;
}

/* ---------------------------------------------------------------- tables */

static cs_profile_table *find_table(const celspan_painting *painting, cs_hash hash) {
  for (size_t i = 0; i < painting->table_count; i++) {
    cs_profile_table *table = painting->tables[i];
    if (table->hash.a == hash.a && table->hash.b == hash.b)
      return table;
  }
  return NULL;
}

static celspan_status get_table(celspan_context *context, const cs_input *input,
                                celspan_painting *painting, const cs_colour_request *request,
                                cs_profile_table **out) {
  *out = find_table(painting, cs_profile_table_hash(request));
  if (*out)
    return CELSPAN_OK;
  if (painting->table_count == CS_PROFILES_MOST)
    return cs_input_fail(context, input, -1, CELSPAN_LIMIT,
                         "has more than %d different colour profiles, which is the limit",
                         CS_PROFILES_MOST);
  CS_TRY(cs_profile_table_create(context, input, request, out));
  painting->tables[painting->table_count++] = *out;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- profiles */

celspan_status cs_profile_read(celspan_context *context, const cs_input *input,
                               celspan_painting *painting, const cs_colour_request *request,
                               cs_profile *out) {
  cs_profile_table *table;
  CS_TRY(get_table(context, input, painting, request, &table));
  *out = (cs_profile){.codes = table->codes, .table = table};
  set_name(out->name, table->light.name);
  return CELSPAN_OK;
}

void cs_profile_of_name(const char *name, cs_profile *out) {
  bool is_grey = strncmp(name, "Gray-D50", 8) == 0, is_srgb = strncmp(name, "sRGB", 4) == 0;
  bool is_linear = strstr(name, "g10") || strstr(name, "inear");
  bool is_known = is_srgb || (is_grey && (is_linear || strstr(name, "srgbtrc")));
  *out = (cs_profile){.codes = !is_known   ? CS_PROFILE_UNKNOWN
                               : is_linear ? CS_PROFILE_LINEAR
                                           : CS_PROFILE_SRGB};
  set_name(out->name, name);
}

/* Whether a power stands for sRGB: programs write 1/2.2 for it. */
static bool is_srgb_power(const cs_colour_request *request) {
  static const uint32_t srgb[] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
  bool is_near = request->power == 45455;
  for (size_t i = 0; request->has_places && i < 8; i++)
    is_near = is_near && llabs((long long)request->places[i] - srgb[i]) <= 300;
  return is_near;
}

celspan_status cs_profile_of_power(celspan_context *context, const cs_input *input,
                                   celspan_painting *painting, const cs_colour_request *request,
                                   cs_profile *out) {
  *out = (cs_profile){.codes = CS_PROFILE_SRGB};
  if (is_srgb_power(request))
    return CELSPAN_OK;
  CS_TRY(cs_profile_read(context, input, painting, request, out));
  snprintf(out->name, sizeof out->name, "gamma %.5g%s", 100000.0 / request->power,
           request->has_places ? " with primaries" : "");
  return CELSPAN_OK;
}

void cs_profile_apply(const cs_profile *profile, cs_contents_layer *layer) {
  layer->table = profile->codes == CS_PROFILE_CONVERTED ? profile->table : NULL;
  layer->colour = layer->table || profile->codes == CS_PROFILE_LINEAR ? "linear" : "srgb";
}

celspan_status cs_profile_note(celspan_context *context, celspan_painting *painting, size_t layer,
                               const cs_profile *profile) {
  if (profile->codes != CS_PROFILE_UNKNOWN)
    return CELSPAN_OK;
  return cs_contents_note(context, painting, layer,
                          "the colour profile \"%s\": its colours are taken as those of sRGB",
                          profile->name[0] ? profile->name : "without a name");
}
