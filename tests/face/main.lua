-- What is made from the public headers: lua5.4 tests/face/main.lua WHAT [ROOT]
--
--   fields   the fields of all descriptions: src/base/fields.h
--   plain    the declarations alone: tests/face/0.1.h, the interface that hosts are built with
--   python   a binding for Python's ctypes
--   compare  what the headers mean for the version, beside tests/face/0.1.h
--   symbols  the functions, one a line

local what, root = arg[1], (arg[2] or ".") .. "/"
package.path = root .. "tests/face/?.lua;" .. package.path
local header = require "header"

local show = {}

function show.fields()
  print [[
/* Where the fields of descriptions begin and end. Printed by `lua5.4 tests/face/main.lua fields`
 * from the public headers; a test compares. */
#pragma once

#define FIELD(type, name) {offsetof(type, name), offsetof(type, name) + sizeof(((type *)0)->name)}
]]
  local face, described = header.parse(header.plain(root)), {}
  for _, one in ipairs(face.functions) do
    described[one.name:match "^(.*)_default$" or ""] = true
  end
  for _, struct in ipairs(face.structs) do
    if described[struct.name] then
      print(("static const cs_description_field %s_fields[] = {"):format(struct.name))
      for _, field in ipairs(struct.fields) do
        print(("    FIELD(%s, %s),"):format(struct.name, field.name))
      end
      print "};"
    end
  end
end

function show.plain() io.write(header.whole(root)) end

function show.python() io.write(require "python".text(header.parse(header.plain(root)))) end

function show.symbols()
  for _, one in ipairs(header.parse(header.plain(root)).functions) do print(one.name) end
end

function show.compare()
  local file = assert(io.open(root .. "tests/face/0.1.h"))
  local verdict, changes = require "compare".texts(file:read "a", header.whole(root))
  file:close()
  for _, change in ipairs(changes) do print(change) end
  print(verdict)
end

show[what]()
