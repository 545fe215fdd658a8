-- What is made from the public headers: lua5.4 tests/face/main.lua WHAT [ROOT]
--
--   plain    the declarations alone: tests/face/0.1.h, the interface that hosts are built with
--   python   a binding for Python's ctypes
--   compare  what the headers mean for the version, beside tests/face/0.1.h
--   symbols  the functions, one a line

local what, root = arg[1], (arg[2] or ".") .. "/"
package.path = root .. "tests/face/?.lua;" .. package.path
local header = require "header"

local show = {}

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
