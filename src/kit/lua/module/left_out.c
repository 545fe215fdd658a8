/* What a celspan of web pages leaves out, because few scripts need it and every page would pay for
 * it: these functions take the places of those in the files that meson.build lists as heavy.
 * celspan-whole.wasm lacks celspan.render alone. */
#include "lua/bind/caller.h"
#include "lua/module/native.h"

#define LACKS(name, what)                                                                          \
  int name(lua_State *L) {                                                                         \
    return cs_caller_error(L, "this celspan has no %s: it is that of web pages", what);            \
  }

LACKS(cs_render_make, "celspan.render")

#ifndef CS_IS_WHOLE

#define LACKS_PLANES(name) LACKS(name, "planes")
LACKS_PLANES(cs_plane_make)
LACKS_PLANES(cs_plane_open_file)
LACKS_PLANES(cs_parcels_list)

void cs_plane_open(lua_State *L) { (void)L; }

#define LACKS_PAINTINGS(name) LACKS(name, "paintings and archives")
LACKS_PAINTINGS(cs_painting_read)
LACKS_PAINTINGS(cs_archive_member)
LACKS_PAINTINGS(cs_archive_size)

#define LACKS_TRACING(name) LACKS(name, "tracing of pictures")
LACKS_TRACING(cs_tracing_make)
LACKS_TRACING(cs_tracing_write)

#define LACKS_TRACKING(name) LACKS(name, "tracking")
LACKS_TRACKING(cs_track_tracker)
LACKS_TRACKING(cs_track_follow)
LACKS_TRACKING(cs_track_rewind)
LACKS_TRACKING(cs_track_inverse)

#define LACKS_RECOLOURING(name) LACKS(name, "recolouring")
LACKS_RECOLOURING(cs_recolour_make)
LACKS_RECOLOURING(cs_recolour_value)
LACKS_RECOLOURING(cs_recolour_see)
LACKS_RECOLOURING(cs_recolour_strange)

#define LACKS_SCANS(name) LACKS(name, "scans")
LACKS_SCANS(cs_scanning_open)
LACKS_SCANS(cs_scanning_close)
LACKS_SCANS(cs_scanning_pegs)
LACKS_SCANS(cs_scanning_corners)
LACKS_SCANS(cs_scanning_shift)
LACKS_SCANS(cs_scanning_lines)

#define LACKS_AREAS(name) LACKS(name, "areas between lines")
LACKS_AREAS(cs_ink_areas_make)
LACKS_AREAS(cs_ink_areas_release)
LACKS_AREAS(cs_ink_areas_at)
LACKS_AREAS(cs_ink_areas_way)
LACKS_AREAS(cs_ink_areas_measures)
LACKS_AREAS(cs_ink_areas_picture)

#define LACKS_RELIGHTING(name) LACKS(name, "relighting")
LACKS_RELIGHTING(cs_relight_size)
LACKS_RELIGHTING(cs_relight_estimate)
LACKS_RELIGHTING(cs_relight_shape)
LACKS_RELIGHTING(cs_relight_picture)
LACKS_RELIGHTING(cs_relight_exposures)
LACKS_RELIGHTING(cs_relight_grounds)
LACKS_RELIGHTING(cs_relight_write)
LACKS_RELIGHTING(cs_relight_read)
LACKS_RELIGHTING(cs_stack_make)
LACKS_RELIGHTING(cs_stack_lights)
LACKS_RELIGHTING(cs_stack_light)

#endif
