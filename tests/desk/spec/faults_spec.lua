-- A program whose calls to the system fail: whichever it is, once or for good, whatever the errno
-- and whatever is written, a render ends with the right frames, or with the exit code of the table
-- and a sentence with a file and the reason; no wrong file has a final name, no temporary file is
-- left, and the same command with --resume then makes the frames. So does joining strips, which
-- starts again.
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local LIBRARY = workbench.build .. "/tests/libfaulty.so"
-- By its name, because a path in LD_PRELOAD ends at a space.
local PRELOADED = ("LD_LIBRARY_PATH='%s/tests' LD_PRELOAD=libfaulty.so"):format(workbench.build)
local ALL = tonumber(os.getenv "CELSPAN_STARVE") -- one call in ALL is tried
local SAMPLES = 1 -- the number of calls of a format that fail with an errno
local FAULTS = tonumber(os.getenv "CELSPAN_FAULTS") or 1
local SHORT, EINTR, EAGAIN = -1, 4, 11

local errors = {
  [28] = "No space left on device", [5] = "Input/output error", [122] = "Disk quota exceeded",
  [13] = "Permission denied", [30] = "Read-only file system", [24] = "Too many open files",
  [36] = "File name too long", [EAGAIN] = "Resource temporarily unavailable",
  [EINTR] = "Interrupted system call",
  [SHORT] = "short",
}
local numbers = {}
for number in pairs(errors) do numbers[#numbers + 1] = number end
table.sort(numbers)

local FILM = [[local celspan = require "celspan"
return celspan.film { size = { 32, 24 }, fps = 4, frames = 2, frame = function(f)
  return celspan.rostrum { back = "#346", celspan.cel {
    celspan.circle { centre = { 8 * f.number, 12 }, radius = 7.5, texture = celspan.linear {
      from = { 0, 0 }, to = { 32, 24 }, { 0, "#f80" }, { 1, "#08f" } } } } }
end }
]]

-- The mix of a film without sounds is silence: no other process decodes any.
local SILENCE = [[local celspan = require "celspan"
local function film(sound)
  return celspan.film { size = { 8, 8 }, fps = 4, frames = 2, sound = sound,
    frame = function() return celspan.rostrum {} end }
end
return film { film() }
]]

local bench, random

setup(function() random = prng.new(tonumber(os.getenv "CELSPAN_SEED") or 1) end)
before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

-- ---------------------------------------------------------------- running

--- Renders, or joins strips, into the folder out of the bench, with the environment of a plan.
local function make(format, plan, options)
  local output = format.is_stream and "- > out/stream" or "out/" .. format.output
  local command = format.joins and "join 'strips/#." .. format.joins .. "'"
    or format.sounds and "sound film.lua"
    or ("render film.lua --workers %d --progress none %s %s"):format(format.workers or 1,
      format.options or "", options or "")
  return bench:shell(("cd '%s' && mkdir -p out && %s '%s' %s -o %s"):format(bench.folder,
    plan or "", workbench.absolute, command, output))
end

--- The strips that a format joins.
local function make_strips(ending)
  for i = 1, 2 do
    local code, _, err =
      bench:shell(("cd '%s' && '%s' render film.lua --frames 1 --size 40x300 --strip %d/2 "
      .. "--progress none -o strips/%d.%s"):format(bench.folder, workbench.absolute, i, i, ending))
    assert.are.equal(0, code, err)
  end
end

local function faulty(at, lasts, number, call)
  return ("FAULT_AT=%d FAULT_LASTING=%d FAULT_ERROR=%d FAULT_COUNT=count %s %s"):format(
    at, lasts and 1 or 0, number, call and "FAULT_CALL=" .. call or "", PRELOADED)
end

--- Every file of the folder out, except celspan's own record, by its name.
local function results()
  local found = {}
  for _, name in ipairs(bench:files "out") do
    if not name:find "%.frames$" then found[name] = bench:read("out/" .. name) end
  end
  return found
end

--- The number of calls, and the name of the first that failed.
local function calls()
  local count, call = (bench:read "count" or "0 none"):match "(%d+) (%S+)"
  return tonumber(count), call
end

-- ---------------------------------------------------------------- what is right

--- Exit codes: an input (the script, its modules) cannot be read; an output; a limit; no thread or
--- process could be started, or there was no memory.
local expected = { [4] = true, [5] = true, [6] = true, [33] = true }

--- Not every call's errno is the reported one.
local others = {
  pthread_create = "thread", fstat64 = "is not a file; a picture must be one",
}

--- The threads that read from and write to ffmpeg may not start: that is reported as a lack of
-- threads, whatever failed first.
local function is_said(err, number, call, lasts)
  return err:find(errors[number], 1, true) or others[call] and err:find(others[call], 1, true)
    or (lasts or call == "pthread_create") and (err:find(others.pthread_create, 1, true)
      or err:find("cannot be started: " .. errors[EAGAIN], 1, true))
end

--- Libraries behind OpenImageIO start threads while they are loaded, and end the process if they
--- cannot; no file has been made by then.
local function is_end_of_libraries(format, code, err)
  return format.has_module and code == 134 and err:find("std::system_error", 1, true)
end

--- A temporary file that could not be removed, or that another process was reported to remove.
local function may_be_left(lasts, number, call)
  return lasts or call == "unlink" or call == "flock" and number == EAGAIN
end

local function check_frames(right, is_complete, where, parts)
  local found = results()
  for name, bytes in pairs(found) do
    local is_part = parts and name:find "^%..*%.part$"
    assert.is_truthy(right[name] or is_part, where .. " left " .. name)
    assert.is_truthy(is_part or bytes == right[name], where .. " made another " .. name)
  end
  for name in pairs(is_complete and right or {}) do
    assert.is_truthy(found[name], where .. " lacks " .. name)
  end
end

--- A stream ends where the fault occurred.
local function check_stream(right, is_complete, where)
  local found, whole = bench:read "out/stream" or "", right.stream
  assert.is_true(is_complete and found == whole or not is_complete
    and whole:sub(1, #found) == found,
    where .. " wrote another stream")
end

local function check(format, right, at, lasts, number)
  os.execute(("rm -rf '%s/out'"):format(bench.folder))
  local code, _, err = make(format, faulty(at, lasts, number))
  local where = ("%s: call %d%s, %s: exit code %d: %s"):format(format.output or "stream", at,
    lasts and " and all after it" or "", errors[number], code, err)
  local _, call = calls()
  if code ~= 0 and not is_end_of_libraries(format, code, err) then
    assert.is_true(expected[code], where)
    assert.is_truthy(format.is_apart or is_said(err, number, call, lasts), where .. call)
    assert.is_truthy(err:find("^celspan: "), where)
  end
  if format.is_stream then return check_stream(right, code == 0, where) end
  check_frames(right, code == 0, where, may_be_left(lasts, number, call))
  if format.is_video or format.sounds then return end
  local again, _, message = make(format, nil, not format.is_drawing and "--resume" or nil)
  assert.are.equal(0, again, where .. "; then: " .. message)
  -- What could not be removed is removed by --resume, which drawings do not have.
  check_frames(right, true, where .. "; then",
    format.is_drawing and may_be_left(lasts, number, call))
end

-- ---------------------------------------------------------------- the formats

local formats = {
  { output = "f.##.png" }, { output = "f.##.png", options = "--depth 16" }, { output = "f.##.tga" },
  { output = "f.##.span" }, { is_stream = true }, { is_stream = true, workers = 2 },
  { output = "f.##.exr", has_module = true, options = "--trust" },
  { output = "f.##.tiff", has_module = true, options = "--trust" },
  { output = "f.##.jpg", has_module = true, options = "--trust" },
  { output = "f.##.dpx", has_module = true, options = "--trust" },
  { output = "f.##.avif", has_module = true, options = "--trust" },
  { output = "f.##.ppm", has_module = true, options = "--trust" },
  -- by other processes, which fail too
  { output = "f.##.exr", has_module = true, is_apart = true },
  { output = "f.#.exr", has_module = true, options = "--layers cels --cryptomatte names" },
  { output = "f.#.ora", options = "--layers cels" },
  { output = "f.#.psd", options = "--layers cels" },
  { output = "f.##.svg", is_drawing = true },
  { output = "f.##.pdf", is_drawing = true, has_module = true },
  { output = "f.wav", sounds = SILENCE },
  { output = "f.mp4", is_video = true }, { output = "f.gif", is_video = true },
  { output = "f.avif", is_video = true, has_module = true, is_apart = true },
  { output = "f.webp", is_video = true, has_module = true, is_apart = true },
  { output = "f.png", joins = "png" }, { output = "f.tga", joins = "tga" },
  { output = "f.span", joins = "span" },
}

local function has_library()
  local library = io.open(LIBRARY)
  if library then library:close() end
  return library
end

local function sweep(format, lasts)
  if not has_library() then return pending "the library that makes calls fail is not built" end
  bench:write("film.lua", format.sounds or FILM)
  if format.joins then make_strips(format.joins) end
  local code, _, err = make(format, faulty(0, false, 5))
  if code ~= 0 and (format.has_module or format.is_video) then return pending(err) end
  assert.are.equal(0, code, err)
  local right, count = results(), calls()
  assert.is_true(count > 10)
  for _, number in ipairs(numbers) do
    if not (lasts and number == EINTR) and (ALL or random:once(FAULTS)) then
      for i = ALL and random:whole(1, ALL) or 1, ALL and count or SAMPLES, ALL or 1 do
        check(format, right, ALL and i or random:whole(1, count), lasts, number)
      end
    end
  end
end

-- ---------------------------------------------------------------- the hooks

--- Calls of POSIX and Linux that make files, processes and threads. Those for large files end in
--- 64.
local KNOWN = [[access faccessat open openat creat close read readv write writev pread preadv
  pwrite pwritev fsync fdatasync sync syncfs rename renameat renameat2 remove link linkat symlink
  unlink unlinkat mkdir mkdirat rmdir stat fstat lstat fstatat statx truncate ftruncate lseek
  fallocate posix_fallocate copy_file_range sendfile flock lockf fcntl fopen fdopen freopen
  fclose fflush fwrite tmpfile opendir fdopendir readdir scandir realpath readlink readlinkat
  mmap mremap memfd_create mkstemp mkostemp mkdtemp pipe pipe2 dup dup2 dup3 fork vfork
  posix_spawn posix_spawnp execv execvp execve popen system wait waitpid pthread_create
  thrd_create socket bind listen accept accept4 connect eventfd signalfd timerfd_create
  inotify_init inotify_init1 inotify_add_watch poll epoll_create1]]

local function read_file(name)
  local file = assert(io.open(name))
  local text = file:read "a"
  file:close()
  return text
end

local function hooks()
  local found = {}
  local list = read_file("tests/faults/calls.h"):match "#define FAULT_CALLS.*"
  for kind, arguments in list:gmatch "(%u+)(%b())" do
    local first, second = arguments:match "^%(%s*([^,()]+),?%s*([%w_]*)"
    if kind == "CALL" then found[second] = true end
    if kind == "DATA" or kind == "NUMBER" or kind == "CLOSE" or kind == "SYNC" then
      found[first] = true
    end
  end
  return found
end

describe("the hooks of tests/faults", function()
  it("are those that the linker inserts", function()
    local wrapped = read_file("tests/meson.build"):match "foreach call : (%b[])"
    local count = 0
    for name in pairs(hooks()) do
      count = count + 1
      assert.is_truthy(wrapped:find("'" .. name .. "'", 1, true),
        "tests/meson.build lacks " .. name)
    end
    assert.are.equal(select(2, wrapped:gsub("'%g-'", "")), count)
  end)

  it("exist for every call to the system that src/ makes", function()
    local build, hooked, seen = workbench.build, hooks(), 0
    local list = io.popen(("find '%s/src' '%s/celspan.p' -name '*.o' -print0 | xargs -0 nm -u 2>&1")
      :format(build, build))
    local made = {}
    for name in list:lines() do
      name = name:match "^%s+U ([%w_]+)$"
      if name then made[name] = true end
    end
    list:close()
    if not made.malloc and not made.realloc then
      return pending "nm, which lists calls, does not work"
    end
    for name in KNOWN:gmatch "%S+" do
      for _, call in ipairs { name, name .. "64" } do
        seen = seen + (made[call] and 1 or 0)
        assert.is_truthy(hooked[call] or not made[call],
          call .. " is made by src/ and is not in calls.h")
      end
    end
    assert.is_true(seen > 25)
  end)
end)

describe("a folder that cannot be read to its end #plain", function()
  -- It has ".", ".." and five files.
  local function list(command, message)
    if not has_library() then return pending "the library that makes calls fail is not built" end
    for i = 1, 5 do bench:write(("f.%d.span"):format(i), "") end
    for at = 1, 8 do
      local plan = faulty(at, false, 5) .. " FAULT_CALL=readdir64 "
      local code, _, err = bench:shell(("cd '%s' && %s '%s' %s"):format(bench.folder, plan,
        workbench.absolute, command))
      assert.is_true(code == 4 or code == 5, ("entry %d: exit code %d: %s"):format(at, code, err))
      assert.is_truthy(err:find(message, 1, true), err)
    end
  end

  it("is not mistaken for one with fewer frames", function()
    list("compare 'f.#.span' 'f.#.span'", "its folder cannot be read: Input/output error")
  end)

  it("is not mistaken for an empty one", function()
    if not has_library() then return pending "the library that makes calls fail is not built" end
    bench:shell(("mkdir '%s/film'"):format(bench.folder))
    local code, _, err = bench:shell(("cd '%s' && %s FAULT_CALL=readdir64 '%s' init film")
      :format(bench.folder, faulty(3, false, 5), workbench.absolute))
    assert.are.equal(5, code)
    assert.is_truthy(err:find("film: cannot be read: Input/output error", 1, true), err)
  end)
end)

describe("if calls to the system fail #plain", function()
  it("once, a module is found again, and no other one is taken", function()
    if not has_library() then return pending "the library that makes calls fail is not built" end
    local format, at = { output = "f.##.exr", options = "--frames 1 --trust" }, 0
    bench:write("film.lua", FILM)
    local code, _, err = make(format)
    if code ~= 0 then return pending(err) end
    local right = results()
    repeat
      at = at + 1
      os.execute(("rm -rf '%s/out'"):format(bench.folder))
      assert.equal(0, (make(format, faulty(at, false, 28, "access"))))
      check_frames(right, true, ("the search %d"):format(at))
    until calls() < at
    assert.is_true(at > 3)
  end)

  for _, format in ipairs(formats) do
    local name = (format.joins and "joining " or "") .. (format.output or "a stream")
      .. (format.workers and " by two workers" or "") .. (format.options or "")
    it("once, " .. name .. " ends well", function() sweep(format, false) end)
    it("for good, " .. name .. " ends well", function() sweep(format, true) end)
  end
end)
