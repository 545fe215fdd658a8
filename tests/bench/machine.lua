--- What the benchmark ran on, as lines of `KEY: VALUE` beside its table.
local machine = {}

local function first_line(command)
  local pipe = assert(io.popen(command .. " 2>/dev/null"))
  local line = pipe:read "l"
  pipe:close()
  return line ~= "" and line or nil
end

local asked = {
  { "processor", "sed -n 's/^model name[^:]*: //p' /proc/cpuinfo" },
  { "cores", "nproc" },
  { "vectors", "for f in avx512f avx2 sse4_1; do grep -m1 -o -w $f /proc/cpuinfo; done" },
  { "memory", "awk '/^MemTotal/ { printf \"%.0f GiB\", $2 / 1048576 }' /proc/meminfo" },
  { "system", "sed -n 's/^PRETTY_NAME=\"\\(.*\\)\"/\\1/p' /etc/os-release" },
  { "compiler", "cc --version" },
  { "celspan", "git log -1 --format=%h,\\ %cs" },
  { "Cairo", "pkg-config --modversion cairo" },
  { "AGG", "dpkg-query -W -f='${Version}' libagg-dev" },
  { "Qt", "pkg-config --modversion Qt5Gui" },
  { "libvips", "pkg-config --modversion vips" },
  { "OpenCV", "pkg-config --modversion opencv4" },
  { "OpenImageIO", "pkg-config --modversion OpenImageIO" },
  { "ffmpeg", "dpkg-query -W -f='${Version}' ffmpeg" },
  { "Node", "node --version" },
}

function machine.write(path, run)
  local file = assert(io.open(path, "w"))
  local function put(key, value) file:write(key, ": ", tostring(value), "\n") end
  put("date", os.date("!%d %B %Y, %H:%M to ", run.began) .. os.date("!%H:%M UTC", run.ended))
  for _, line in ipairs(asked) do
    local value = first_line(line[2])
    if value then put(line[1], value) end
  end
  put("shapes", run.has_material and "read from CELSPAN_MATERIAL" or "made by the same rule")
  if run.is_quick then put("kind", "a quick run: a few points, each once") end
  for _, note in ipairs(run.notes) do put("note", note) end
  assert(file:close())
end

--- { { key, value }, ... } of a file.
function machine.read(path)
  local list = {}
  for line in io.lines(path) do
    local key, value = line:match "^(.-): (.*)$"
    if key then list[#list + 1] = { key, value } end
  end
  return list
end

return machine
