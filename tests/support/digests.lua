-- Digests of everything that celspan draws in this tree, to compare before and after a change that
-- must not alter a bit. From the top of the tree:
--
--   lua5.4 tests/support/digests.lua [--quick] BUILD [BENCH_BUILD FOLDER] > before
--
-- BUILD contains the celspan to test. BENCH_BUILD was configured with -Dbench=true; the drawings of
-- the benchmark are written into FOLDER, with CELSPAN_MATERIAL's artwork if that is set. Each line
-- is `KIND NAME DIGEST`, in a fixed order. --quick leaves out the slow ones. A failure has the
-- digest `failed`; then the exit status is 1.
package.path = "./?.lua;" .. package.path
local golden = require "tests.support.golden"
local markdown = require "tests.support.markdown"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local words, is_quick = {}, false
for _, word in ipairs(arg) do
  if word == "--quick" then is_quick = true else words[#words + 1] = word end
end
local build, bench_build, folder = table.unpack(words)
assert(build and (not bench_build or folder),
  "usage: digests.lua [--quick] BUILD [BENCH_BUILD FOLDER]")
local celspan = build .. "/celspan"
local bench = workbench.new()
local has_failed = false


--- The output of the command, or nil if it fails; its messages go to standard error.
local function output_of(...)
  local quoted = {}
  for i, word in ipairs { ... } do quoted[i] = system.quote(word) end
  local code, out, err = bench:shell(table.concat(quoted, " "))
  if code == 0 then return out end
  io.stderr:write(err)
end

local function digest_of_file(path) return output_of("md5sum", path):match "%x+" end

local function put(kind, name, digest)
  has_failed = has_failed or not digest
  print(kind .. " " .. name:gsub("%s", "_") .. " " .. (digest or "failed"))
  io.flush()
end

local function put_text(kind, name, ...)
  local text = output_of(...)
  put(kind, name, text and digest_of_file(bench:write("text", text)))
end

-- ---------------------------------------------------------------- scripts

--- A line for each frame of the list: `celspan render --hash` and its options.
local function put_frames(kind, name, script, frames, ...)
  local text = output_of(celspan, "render", script, "--hash", "--progress", "none", "--workers",
    "2", "--frames", table.concat(frames, ","), ...)
  local digests = {}
  for frame, digest in (text or ""):gmatch "(%-?%d+) (%x+)" do digests[tonumber(frame)] = digest end
  for _, frame in ipairs(frames) do put(kind, name .. "/" .. frame, digests[frame]) end
end

--- Frames spread evenly over a script's film, including the first and the last one.
local function frames_of(script, count)
  local told = output_of(celspan, "info", script) or "first 1\nlast 1\n"
  local first, last = told:match "first (%-?%d+)", told:match "last (%-?%d+)"
  local list = {}
  for i = 0, count - 1 do
    local frame = first + (last - first) * i // (count - 1)
    if frame ~= list[#list] then list[#list + 1] = math.tointeger(frame) end
  end
  return list
end

local variants = {
  { "area", "--antialias", "area" },
  { "none", "--antialias", "none" },
  { "gaussian", "--antialias", "gaussian" },
  { "float", "--depth", "float" },
  { "lanczos", "--antialias", "lanczos:4", is_slow = true },
  { "cropped", "--crop", "101,51,203,97", "--depth", "16", is_slow = true },
  { "alone", "--workers", "1", is_slow = true },
}

local function put_script(path)
  local name = path:match "([%w_]+)%.lua$"
  local frames = frames_of(path, is_quick and 3 or 5)
  for _, variant in ipairs(variants) do
    if not (is_quick and variant.is_slow) then
      put_frames("script", name .. "/" .. variant[1], path, frames, "--size", "480x270",
        table.unpack(variant, 2))
    end
  end
  local middle = frames[#frames // 2 + 1]
  for _, antialias in ipairs { "area", "none", "gaussian" } do
    put_text("spans", ("%s/%s/%d"):format(name, antialias, middle), celspan, "spans", path,
      "--frame", middle, "--size", "96x54", "--antialias", antialias)
  end
end

-- ---------------------------------------------------------------- pictures of the pages, files

local function put_page_picture(picture)
  local script, options = picture.script, picture.size and { "--size", picture.size } or {}
  if not script then
    for _, block in ipairs(markdown.blocks(picture.page)) do
      if block.name == picture.name then
        script = bench:write(block.name .. ".lua", block.text)
        options[#options + 1] = block.options ~= "" and block.options or nil
      end
    end
  end
  put_frames("page", picture.name, script, { picture.frame or 1 }, table.unpack(options))
end

--- The bytes of finished files, and of a pyramid of tiles with the names of its files.
local function put_files()
  for _, ending in ipairs { "png", "span", "tga" } do
    local path = bench.folder .. "/demo." .. ending
    local made = output_of(celspan, "render", "scripts/demo.lua", "--frames", "60", "--size",
      "640x360", "--progress", "none", "-o", path)
    put("file", "demo." .. ending, made and digest_of_file(path))
  end
  local tiles = bench.folder .. "/tiles"
  local is_made = output_of(celspan, "tiles", "scripts/booleans.lua", "--frame", "24", "--size",
    "3000x1000", "--progress", "none", "-o", tiles)
  if not is_made then return put("file", "tiles") end
  put_text("file", "tiles", "sh", "-c", "cd '" .. tiles .. "' && " ..
    "find . -type f | LC_ALL=C sort | xargs md5sum")
end

-- ---------------------------------------------------------------- the benchmark

local program = bench_build and bench_build .. "/tests/bench/bench_celspan"

--- One line: the digest of the spans, of the 8-bit pixels, and of the pixels of pictures that keep
--- their codes.
local function put_bench(kind, name, ...)
  local line = output_of(program, ...) or ""
  local digests = {}
  for _, key in ipairs { "span_digest", " digest", "code_digest" } do
    digests[#digests + 1] = (" " .. line):match(key .. " (%x+)")
  end
  put(kind, name, #digests == 3 and table.concat(digests, "-") or nil)
end

local function put_drawing(name, side, antialias)
  put_bench("drawing", ("%s/%d/%s"):format(name, side, antialias), "digest",
    ("%s/%s.txt"):format(folder, name), side, antialias)
end

local drawings = { "10", "100", "1000", "opaque", "faint", "small", "clovers" }
local filtered = { "10", "100", "opaque", "clovers" }

local function put_drawings(names)
  local sides = is_quick and { 1024 } or { 1024, 4096 }
  for _, name in ipairs(names) do
    for _, side in ipairs(sides) do
      for _, antialias in ipairs { "area", "none" } do put_drawing(name, side, antialias) end
    end
  end
  for _, name in ipairs(filtered) do
    for _, kernel in ipairs { "box", "gaussian", "mitchell", "lanczos" } do
      put_drawing(name, is_quick and 256 or 1024, kernel)
    end
  end
  if not is_quick then put_drawing("100", 30000, "area") end
end

local function put_defocus()
  for _, kernel in ipairs { "gaussian", "box", "disc" } do
    for _, radius in ipairs(is_quick and { 5 } or { 0.7, 5, 50 }) do
      put_bench("defocus", ("100/%g/%s"):format(radius, kernel), "soft", folder .. "/100.txt", 1024,
        radius, kernel, "digest")
    end
  end
end

local function put_pictures()
  assert(output_of(bench_build .. "/tests/bench/bench_pictures", folder))
  for _, job in ipairs { "affine", "perspective", "shift" } do
    put_bench("picture", job, "picture", job, folder, "digest")
  end
  for _, sampling in ipairs { "nearest", "bilinear" } do
    for _, side in ipairs { 300, 1000, 4000 } do
      put_bench("picture", ("backed/%s/%d"):format(sampling, side), "backed",
        "scripts/pictures/village.png", sampling, side, "digest", folder .. "/clovers.txt")
    end
  end
  put_bench("picture", "planes", "planes", "scripts/pictures", "digest")
end

-- ---------------------------------------------------------------- all of it

for _, case in ipairs(golden.cases()) do
  put_text("golden", case:match "golden/(.*)", celspan, "spans", case .. ".lua")
end
local listed = output_of("sh", "-c", "LC_ALL=C ls scripts/*.lua")
for path in listed:gmatch "[^\n]+" do put_script(path) end
if not is_quick then
  for _, picture in ipairs(require "docs.pictures.list") do put_page_picture(picture) end
  put_files()
end
if bench_build then
  local scenes = require "tests.bench.scenes"
  assert(output_of("mkdir", "-p", folder))
  local names = table.move(drawings, 1, #drawings, 1, {})
  if scenes.write(folder) then
    table.move(scenes.artwork, 1, #scenes.artwork, #names + 1, names)
  else
    io.stderr:write "no CELSPAN_MATERIAL: other drawings are made, and artwork is left out\n"
  end
  put_drawings(names)
  put_defocus()
  if not is_quick then put_pictures() end
end
bench:remove()
os.exit(has_failed and 1 or 0)
