--- celspan plane FILE -o PAGE: a page that shows a plane at any size, by the element celspan-film.
--- The plane and the element, with its decoder as WebAssembly, are in the page. Without a FILE, the
--- script of the element alone.
local program, request = ...

local DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
local GROUPS = 1 << 16 -- groups of three bytes that are coded at a time

--- All 4096 pairs of digits, indexed by 12 bits.
local function make_pairs()
  local pairs_of = {}
  for i = 0, 4095 do
    local high, low = i >> 6, i & 63
    pairs_of[i] = DIGITS:sub(high + 1, high + 1) .. DIGITS:sub(low + 1, low + 1)
  end
  return pairs_of
end

local function base64(bytes)
  local pairs_of, parts, digits = make_pairs(), {}, {}
  local rest = #bytes % 3
  for start = 1, #bytes - rest, 3 * GROUPS do
    local stop = math.min(start + 3 * GROUPS - 1, #bytes - rest)
    for i = start, stop, 3 do
      local a, b, c = bytes:byte(i, i + 2)
      local bits = a << 16 | b << 8 | c
      digits[(i - start) // 3 + 1] = pairs_of[bits >> 12] .. pairs_of[bits & 4095]
    end
    parts[#parts + 1] = table.concat(digits, "", 1, (stop - start + 1) // 3)
  end
  if rest > 0 then
    local a, b = bytes:byte(-rest, -1)
    if rest == 1 then a, b = bytes:byte(-1), 0 end
    local bits = a << 16 | b << 8
    parts[#parts + 1] = (pairs_of[bits >> 12] .. pairs_of[bits & 4095]):sub(1, rest + 1)
      .. ("="):rep(3 - rest)
  end
  return table.concat(parts)
end

local function bytes_of(path)
  local file, message = io.open(path, "rb")
  local bytes = file and file:read "a"
  if file then file:close() end
  return bytes or program.fail("input", "%s", message or path)
end

local page = request.output
if not page then program.usage "-o is missing: give -o page.html" end
local path, is_script = request[1], program.has_ending(page, ".js")
if path and not program.has_ending(page, ".html", ".htm") then
  program.usage("%s: a page is an HTML file: give it a name that ends in .html", page)
elseif not path and not is_script then
  program.usage("%s: which plane? Without a FILE, only the player is written, to a name that ends "
    .. "in .js", page)
end
local module = program.text "plane.module"
if module == "none" then
  program.fail("input", "this celspan was built without clang and lld, which make the decoder of "
    .. "pages: install them, for example the Debian packages clang and lld, and build it again")
end
local function filled(name, fields) return (program.text(name):gsub("@(%u+)@", fields)) end
local player = filled("celspan-film.js", {
  VERSION = require "celspan"._VERSION:match "%S+$", VIEWER = program.text "viewer.js",
  DECODER = filled("decoder.js", { MODULE = module }),
})
if not path then return program.save(page, player) end
program.refuse_self(path, page)
program.plane(path) -- fails if the file is not a plane
program.save(page, filled("plane.html", {
  TITLE = program.markup(request.title or path:match "[^/]*$"),
  PLAYER = player, PLANE = base64(bytes_of(path)),
}))
