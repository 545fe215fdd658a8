--- celspan check --files: the files that a film reads, for those who copy it to another machine.
local program, opened, request = ...

local script = request[1]

local KINDS = { lua = "module", ttf = "font", otf = "font", ttc = "font", otc = "font",
  wav = "sound", flac = "sound", ogg = "sound", opus = "sound", mp3 = "sound", m4a = "sound",
  aif = "sound", aiff = "sound", csv = "data", tsv = "data", json = "data", txt = "data",
  mp4 = "movie", m4v = "movie", mov = "movie", mkv = "movie", webm = "movie", avi = "movie",
  mxf = "movie", ogv = "movie", ts = "movie", y4m = "movie",
  srt = "data", vtt = "data", xdts = "data", cube = "data", dat = "data", ocio = "data",
  ocioz = "data", dzi = "tiles" }
local LEVEL_MOST = 24 -- of a picture in tiles
local CONTENTS = { folder = "painting", archive = "painting", psd = "painting", svg = "drawing" }

--- The kind of a file: by its ending, and otherwise by its content.
local function kind_of(path)
  if path == script then return "script" end
  local ending = path:lower():match "%.([^./]*)$"
  if KINDS[ending] then return KINDS[ending] end
  local kind = program.kind(path)
  return CONTENTS[kind] or kind
end

--- Adds the tiles of a picture.
local function add_tiles(path, paths)
  for level = 0, path:lower():find "%.dzi$" and LEVEL_MOST or -1 do
    local folder = ("%s_files/%d"):format(path:sub(1, -5), level)
    for _, name in ipairs(program.entries(folder) or {}) do
      if name:find "^%d+_%d+%." then paths[#paths + 1] = folder .. "/" .. name end
    end
  end
end

--- The files that the command line and the environment name.
local function given()
  local list, configuration = {}, request.ocio or os.getenv "OCIO" or ""
  if configuration ~= "" and not configuration:find "^ocio://" then
    list = program.part("luts.lua", program, configuration)
  end
  if script ~= "-" then list[#list + 1] = script end
  list[#list + 1] = request.set_from
  return list
end

--- A list of { path =, kind =, size =, sha256 = }, sorted by path, without places where a file was
--- looked for and not found.
local function reads()
  local list, seen, paths = {}, {}, given()
  for path in opened:files():gmatch "%+(%Z+)%z" do
    paths[#paths + 1] = path
    add_tiles(path, paths)
  end
  for _, path in ipairs(paths) do
    local sum, size = program.sha256(path)
    if sum and not seen[path] then
      seen[path] = true
      list[#list + 1] = { path = path, kind = kind_of(path), size = size, sha256 = sum }
    end
  end
  table.sort(list, function(a, b) return a.path < b.path end)
  return list
end

return reads()
