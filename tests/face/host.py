"""examples/hello.c in Python: python3 host.py BINDING LIBRARY PICTURE"""
import importlib.util
import sys
from ctypes import byref, c_void_p, pointer, cast

spec = importlib.util.spec_from_file_location("celspan", sys.argv[1])
celspan = importlib.util.module_from_spec(spec)
spec.loader.exec_module(celspan)
lib = celspan.load(sys.argv[2])


def check(status):
    if status != celspan.CELSPAN_OK:
        sys.exit(lib.celspan_context_error(context).decode())


context, disc, sheet, scene = c_void_p(), c_void_p(), c_void_p(), c_void_p()
check(lib.celspan_context_create(None, byref(context)))
ellipse = celspan.begin(celspan.celspan_ellipse_desc)
ellipse.centre.x = ellipse.centre.y = 60
ellipse.radius_x = ellipse.radius_y = 40
check(lib.celspan_object_create_ellipse(context, byref(ellipse), byref(disc)))
cel = celspan.begin(celspan.celspan_cel_desc)
cel.objects, cel.object_count = cast(pointer(disc), c_void_p), 1
check(lib.celspan_cel_create(context, byref(cel), byref(sheet)))
rostrum = celspan.begin(celspan.celspan_rostrum_desc)
rostrum.cels, rostrum.cel_count = cast(pointer(sheet), c_void_p), 1
rostrum.back = celspan.celspan_light(1, 1, 1, 1)
check(lib.celspan_rostrum_create(context, byref(rostrum), byref(scene)))
check(lib.celspan_rostrum_write(context, scene, 120, 120, sys.argv[3].encode()))
lib.celspan_object_unref(disc)
lib.celspan_cel_unref(sheet)
lib.celspan_rostrum_unref(scene)
lib.celspan_context_destroy(context)
