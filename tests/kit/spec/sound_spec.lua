-- Sounds: their formats are found from the first bytes, and ffmpeg decodes them where the kernel
-- lets it do nothing else. Whatever a file contains, nothing outside of the script's folder is
-- read, no run hangs, and no process is left.

local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local HOSTILE = workbench.build .. "/tests/hostile_ffmpeg"
local SECONDS = 120 -- after which one that hangs is killed
local NO_FORMAT = "has none of the formats that are read.*: convert it to wav, mp3, flac, ogg, opus"

local FILM = [[
local celspan = require "celspan"
local sound, seconds = ...
return celspan.film { size = { 8, 8 }, fps = 8, frames = 8 * (tonumber(seconds) or 1),
  sound = sound, frame = function() return celspan.rostrum {} end }
]]

-- ---------------------------------------------------------------- files

--- A chunk of RIFF; size: what it says of its bytes.
local function chunk(name, data, size) return name .. ("<I4"):pack(size or #data) .. data end

--- A WAV file; fields that are missing are those of a second of silence.
local function wav(fields)
  fields = fields or {}
  local rate, channels = fields.rate or 8000, fields.channels or 1
  local data = fields.data or ("\0\0"):rep(8000)
  local form = ("<I2I2I4I4I2I2"):pack(fields.code or 1, channels, rate, rate * 2 & 0xffffffff,
    fields.align or 2 * channels & 0xffff, fields.bits or 16)
  local body = "WAVE" .. (fields.before or "") .. chunk("fmt ", form, fields.form_size)
    .. chunk("data", data, fields.size)
  return (fields.name or "RIFF") .. ("<I4"):pack(fields.whole or #body) .. body
end

--- A second of a loud tone.
local function tone()
  return wav { data = ("<i2<i2"):pack(24000, -24000):rep(4000) }
end

local function atom(name, body, size) return (">I4"):pack(size or 8 + #body) .. name .. body end

--- A QuickTime film whose samples are in another file: an alias, as editors write it.
local function external(path, brand)
  local alias = ("\0"):rep(10) .. (">s1c27"):pack("disk", "") .. ("\0"):rep(12 - 4)
    .. (">s1c63"):pack("secret.wav", "") .. ("\0"):rep(16) .. (">I2I2"):pack(1, 1)
    .. ("\0"):rep(16) .. (">I2s2"):pack(2, path) .. (#path % 2 == 1 and "\0" or "")
    .. (">I2I2"):pack(0xffff, 0)
  local reference = atom("dref", (">I4I4"):pack(0, 1) .. atom("alis", ("\0"):rep(4) .. alias))
  local entry = atom("sowt", (">c6I2I4I4I2I2I4I4"):pack("", 1, 0, 0, 1, 16, 0, 8000 << 16))
  local tables = atom("stbl", atom("stsd", (">I4I4"):pack(0, 1) .. entry)
    .. atom("stts", (">I4I4I4I4"):pack(0, 1, 8000, 1))
    .. atom("stsc", (">I4I4I4I4I4"):pack(0, 1, 1, 8000, 1))
    .. atom("stsz", (">I4I4I4"):pack(0, 2, 8000)) .. atom("stco", (">I4I4I4"):pack(0, 1, 44)))
  local media = atom("mdia", atom("mdhd", (">I4I4I4I4I4I4"):pack(0, 0, 0, 8000, 8000, 0))
    .. atom("hdlr", (">I4c4c4I4I4I4B"):pack(0, "mhlr", "soun", 0, 0, 0, 0))
    .. atom("minf", atom("smhd", ("\0"):rep(8)) .. atom("dinf", reference) .. tables))
  local track = atom("trak", atom("tkhd", (">I4I4I4I4I4I4c60"):pack(15, 0, 0, 1, 0, 8000, ""))
    .. media)
  return atom("ftyp", (brand or "qt  ") .. ("\0"):rep(4))
    .. atom("moov", atom("mvhd", (">I4I4I4I4I4c80"):pack(0, 0, 0, 8000, 8000, "")) .. track)
end

--- An element of Matroska with an identifier of four bytes.
local function element(name, body) return name .. (">I4"):pack(0x10000000 | #body) .. body end

local function hls(address, more)
  return "#EXTM3U\n#EXT-X-TARGETDURATION:1\n" .. (more or "") .. "#EXTINF:1.0,\n" .. address
    .. "\n#EXT-X-ENDLIST\n"
end

--- Files that are no sounds, by name; OUT: the folder with the secret sound.
local REFUSED = {
  ["absolute.wav"] = hls "OUT/secret.wav",
  ["above.wav"] = hls "../secret.wav",
  ["address.mp3"] = hls "file://OUT/secret.mp3",
  ["network.m4a"] = hls "http://127.0.0.1:9/secret.ts",
  ["list.m3u8"] = hls "../secret.wav",
  ["key.wav"] = hls("good.wav", '#EXT-X-KEY:METHOD=AES-128,URI="file://OUT/secret.wav"\n'),
  ["map.wav"] = hls("good.wav", '#EXT-X-MAP:URI="../secret.wav"\n'),
  ["master.wav"] = "#EXTM3U\n#EXT-X-STREAM-INF:BANDWIDTH=1\nabove.wav\n",
  ["marked.wav"] = "\xef\xbb\xbf" .. hls "../secret.wav",
  ["plain.m3u"] = "../secret.wav\n",
  ["list.pls"] = "[playlist]\nFile1=OUT/secret.wav\nNumberOfEntries=1\n",
  ["list.xspf"] = "<?xml version='1.0'?><playlist><trackList><track><location>../secret.wav"
    .. "</location></track></trackList></playlist>",
  ["list.asx"] = "<asx version='3.0'><entry><ref href='OUT/secret.wav'/></entry></asx>",
  ["list.ram"] = "file://OUT/secret.wav\n",
  ["concat.wav"] = "ffconcat version 1.0\nfile 'OUT/secret.wav'\n",
  ["concat-above.wav"] = "ffconcat version 1.0\nfile '../secret.wav'\n",
  ["concat-link.wav"] = "ffconcat version 1.0\nfile around/secret.wav\n",
  ["concat-address.mp3"] = "ffconcat version 1.0\nfile file:../secret.wav\n",
  ["concat-stream.ogg"] = "ffconcat version 1.0\nfile subfile,,start,0,end,0,,:../secret.wav\n",
  ["session.sdp"] = "v=0\no=- 0 0 IN IP4 127.0.0.1\ns=x\nc=IN IP4 127.0.0.1\nt=0 0\n"
    .. "m=audio 5004 RTP/AVP 0\n",
  ["dash.mpd"] = "<?xml version='1.0'?><MPD xmlns='urn:mpeg:dash:schema:mpd:2011'><Period>"
    .. "<BaseURL>file://OUT/</BaseURL></Period></MPD>",
  ["smooth.ism"] = "<SmoothStreamingMedia><StreamIndex Url='../secret.wav'/>"
    .. "</SmoothStreamingMedia>",
  ["disc.cue"] = 'FILE "../secret.wav" WAVE\n  TRACK 01 AUDIO\n    INDEX 01 00:00:00\n',
  ["graph.wav"] = "amovie=../secret.wav\n",
  ["data.wav"] = ";FFMETADATA1\ntitle=../secret.wav\n",
  ["words.srt"] = "1\n00:00:00,000 --> 00:00:01,000\nla la la\n",
  ["link.avs"] = 'WAVSource("../secret.wav")\n',
  ["script.wav"] = "#!/bin/sh\ncat ../secret.wav\n",
  ["text.wav"] = "no sound at all",
  ["empty.wav"] = "",
  ["byte.wav"] = "R",
  ["short.wav"] = "RIFF\0\0\0\0",
  ["turned.wav"] = "RIFX\0\0\0\0WAVEfmt ",
  ["large.w64"] = "riff\x2e\x91\xcf\x11\xa5\xd6\x28\xdb\x04\xc1\0\0" .. ("\0"):rep(64),
  ["zeros.mp3"] = ("\0"):rep(4096),
  ["ones.mp3"] = ("\xff"):rep(4096),
  ["layer.mp2"] = "\xff\xfd\xc4\0" .. ("\0"):rep(800),
  ["stream.aac"] = "\xff\xf1\x50\x80\x01\x7f\xfc" .. ("\0"):rep(40),
  ["tag.mp3"] = "ID3\4\0\0\0\0\0\10" .. ("\0"):rep(10) .. hls "../secret.wav",
  ["long-tag.mp3"] = "ID3\4\0\0\x7f\x7f\x7f\x7f" .. ("\0"):rep(64),
  ["tag-stream.mp3"] = "ID3\4\0\0\0\0\0\0\xff\xf1\x50\x80\x01\x7f\xfc" .. ("\0"):rep(40),
  ["reference.mov"] = atom("moov", atom("rmra", atom("rmda", atom("rdrf", "\0\0\0\0url \0\0\0\14"
    .. "../secret.wav")))),
  ["external.mov"] = external("OUT/secret.wav"):sub(17),
  ["picture.wav"] = "\x89PNG\r\n\x1a\n" .. ("\0"):rep(64),
  ["picture.gif"] = "GIF89a" .. ("\0"):rep(64),
  ["audio.aiff"] = "FORM\0\0\0\4AIFF",
  ["audio.au"] = ".snd" .. (">I4I4I4I4I4"):pack(24, 8, 3, 8000, 1) .. ("\0"):rep(8),
  ["audio.caf"] = "caff\0\1\0\0",
  ["module.mod"] = ("\0"):rep(1080) .. "M.K." .. ("\0"):rep(64),
  ["notes.mid"] = "MThd\0\0\0\6\0\0\0\1\0\96MTrk\0\0\0\4\0\xff\x2f\0",
  ["archive.wav"] = "PK\3\4" .. ("\0"):rep(64),
  ["packed.wav"] = "\x1f\x8b\8\0" .. ("\0"):rep(64),
  ["page.svg"] = '<svg xmlns="http://www.w3.org/2000/svg"><image href="../secret.wav"/></svg>',
  ["entity.wav"] = '<!DOCTYPE x [<!ENTITY e SYSTEM "file://OUT/secret.wav">]><x>&e;</x>',
}

--- Files with the first bytes of a format: what is read is silent, and what cannot be read is
--- refused. `good` is a WAV file of silence.
local good = wav()
local STRANGE = {
  ["clip.wav"] = "RIFF\0\0\0\0AVI LIST",
  ["stream.ts"] = ("\x47\0\0\x10" .. ("\xff"):rep(184)):rep(8),
  ["head.mxf"] = "\x06\x0e\x2b\x34\2\5\1\1\13\1\2\1\1\2\4\0" .. ("\0"):rep(400),
  ["attached.mkv"] = element("\x1a\x45\xdf\xa3", "\x42\x82\x88matroska")
    .. element("\x18\x53\x80\x67", element("\x19\x41\xa4\x69", "\x61\xa7\x80")),
  ["linked.mka"] = element("\x1a\x45\xdf\xa3", "\x42\x82\x88matroska")
    .. element("\x18\x53\x80\x67", element("\x15\x49\xa9\x66", "\x3e\x83\xbb\x8d../secret.mkv")),
  ["good.wav"] = good,
  ["reading.txt"] = good,
  ["slow.wav"] = wav { rate = 3, data = ("\0\0"):rep(3) },
  ["still.wav"] = wav { rate = 0 },
  ["fast.wav"] = wav { rate = 0xffffffff },
  ["none.wav"] = wav { channels = 0 },
  ["crowd.wav"] = wav { channels = 65535 },
  ["hundred.wav"] = wav { channels = 100 },
  ["align.wav"] = wav { align = 0 },
  ["bits.wav"] = wav { bits = 0 },
  ["deep.wav"] = wav { bits = 65535 },
  ["nothing.wav"] = wav { data = "" },
  ["zero.wav"] = wav { size = 0 },
  ["endless.wav"] = wav { size = 0xffffffff, whole = 0xffffffff },
  ["past.wav"] = wav { size = 0x7fffffff },
  ["formless.wav"] = wav { form_size = 0 },
  ["long-form.wav"] = wav { form_size = 0xfffffff0 },
  ["chunks.wav"] = wav { before = chunk("LIST", ""):rep(20000) },
  ["odd.wav"] = wav { before = chunk("junk", "x", 1) },
  ["coded.wav"] = wav { code = 0x55, data = ("\xff\xfb\x90\0" .. ("\0"):rep(413)):rep(3) },
  ["adaptive.wav"] = wav { code = 2, bits = 4, align = 1 },
  ["foreign.wav"] = wav { code = 0xfffe },
  ["windows.wav"] = wav { code = 0x161 },
  ["within.wav"] = wav { data = hls "../secret.wav" },
  ["head.wav"] = "RIFF\0\0\0\0WAVE",
  ["large.wav"] = wav { name = "RF64", before = chunk("ds64", ("<I8I8I8I4"):pack(1 << 62, 1 << 62,
    1 << 62, 0xffffffff)), whole = 0xffffffff, size = 0xffffffff },
  ["frame.mp3"] = "\xff\xfb\x90\0",
  ["torn.mp3"] = ("\xff\xfb\x90\0" .. ("\xaa"):rep(100)):rep(8),
  ["tagged.mp3"] = "ID3\4\0\0\0\0\0\0" .. ("\xff\xfb\x90\0" .. ("\0"):rep(413)):rep(9),
  ["head.flac"] = "fLaC",
  ["endless.flac"] = "fLaC" .. ("\0\0\0\0"):rep(4000),
  ["head.ogg"] = "OggS",
  ["pages.ogg"] = ("OggS\0\2" .. ("\0"):rep(20) .. "\1\0"):rep(2000),
  ["stream.ogg"] = "OggS" .. hls "../secret.wav",
  ["brand.m4a"] = atom("ftyp", "M4A "),
  ["zero.m4a"] = atom("ftyp", "M4A ") .. atom("moov", "", 0),
  ["huge.m4a"] = atom("ftyp", "M4A ") .. atom("moov", "\xff\xff\xff\xff\xff\xff\xff\xff", 1),
  ["nested.m4a"] = atom("ftyp", "M4A ") .. (">I4"):pack(0x7fffffff):rep(1) .. ("moov"
    .. (">I4"):pack(0x7fffff00)):rep(20000),
  ["samples.m4a"] = external("x", "M4A "):gsub("stsz........", "stsz\0\0\0\0\0\0\0\2"),
  ["external.m4a"] = external("OUT/secret.wav", "M4A "),
  ["alias.mov"] = external "../secret.wav",
  ["linked-alias.mov"] = external "around/secret.wav",
  ["concat:good.wav|secret.wav"] = good,
  ["subfile,,start,0,end,0,,:secret.wav"] = good,
  ["frame%03d.wav"] = good,
  ["-i"] = good,
  ["pipe:0"] = good,
}

--- Arguments that name no file of the folder, and a part of the message.
local MISSING = {
  { "nowhere.wav", "cannot be opened: No such file" },
  { "data:audio/wav;base64", "film: sound 1: the sound data:%.%.%. is damaged: it must have a" },
  { "data:audio/wav;base64,UklG*", "the sound data:%.%.%. is damaged" },
  { "data:,no sound at all", "the sound data:%.%.%. has none of the formats" },
  { "DATA:audio/mpegurl,#EXTM3U%0afile:///OUT/secret.wav", NO_FORMAT },
  { "../secret.wav", "scripts in the sandbox can read only" },
  { "OUT/secret.wav", "scripts in the sandbox can read only" },
  { "around/secret.wav", "scripts in the sandbox can read only" },
  { "link.wav", "scripts in the sandbox can read only" },
  { "file:../secret.wav", "cannot be opened: No such file" },
  { "concat:../secret.wav", "cannot be opened: No such file" },
  { "data:audio/wav;base64,UklGRg", "the sound data:%.%.%. has none of the formats" },
  { "http://127.0.0.1:9/secret.wav", "cannot be opened: No such file" },
  { "folder", "cannot be opened: Is a directory" },
  { "pipe", "is not a file; a sound must be one" },
  { "/dev/zero", "is not a file; a sound must be one", "--allow /dev" },
  { "dangling.wav", "cannot be opened: No such file" },
  { "circle.wav", "scripts in the sandbox can read only" },
}

-- ---------------------------------------------------------------- running

local bench

--- The folder: OUT with a secret, and in it the folder of the script.
before_each(function()
  bench = workbench.new()
  assert(os.execute(("mkdir '%s/in' '%s/bin'"):format(bench.folder, bench.folder)))
  bench:write("in/film.lua", FILM)
end)
after_each(function() bench:remove() end)

local function in_folder(command, ...)
  return bench:shell(("cd '%s/in' && "):format(bench.folder) .. command:format(...))
end

local function with_out(text) return (text:gsub("OUT", bench.folder)) end

--- A list of commands for xargs, each with a number, the sound and options.
local function write_cases(cases)
  local list = {}
  for i, case in ipairs(cases) do
    list[i] = ("%d\0%s\0%s\0"):format(i, case.name, case.options or "")
  end
  bench:write("cases", table.concat(list))
end

--- Checks each sound in a process of its own; gives case.code and case.err.
local function check_all(cases, before)
  write_cases(cases)
  local one = ([[timeout -s KILL %d '%s' check film.lua --deep $3 -- "$2" 2>'%s/err.'$1 >&2
    echo $? >>'%s/err.'$1]]):format(SECONDS, workbench.absolute, bench.folder, bench.folder)
  bench:write("one.sh", one)
  in_folder("%s xargs -0 -n 3 -P 2 sh ../one.sh <../cases", before or "")
  for i, case in ipairs(cases) do
    local text = assert(bench:read("err." .. i), case.name)
    case.err, case.code = text:match "^(.-)(%d+)\n$"
    case.code = tonumber(case.code)
  end
end

local function sorted_names(files)
  local names = {}
  for name in pairs(files) do names[#names + 1] = name end
  table.sort(names)
  return names
end

local function write_files()
  bench:write("secret.wav", tone())
  for _, list in ipairs { REFUSED, STRANGE } do
    for name, bytes in pairs(list) do bench:write("in/" .. name, with_out(bytes)) end
  end
  local code, _, err = in_folder("ln -s .. around && ln -s ../secret.wav link.wav && mkdir folder "
    .. "&& mkfifo pipe && ln -s nowhere dangling.wav && ln -s circle.wav circle.wav")
  assert.equal(0, code, err)
end

local function all_cases()
  local cases = {}
  for _, name in ipairs(sorted_names(REFUSED)) do
    cases[#cases + 1] = { name = name, pattern = NO_FORMAT }
  end
  for _, name in ipairs(sorted_names(STRANGE)) do
    cases[#cases + 1] = { name = name, is_strange = true }
  end
  for _, one in ipairs(MISSING) do
    cases[#cases + 1] = { name = with_out(one[1]), pattern = one[2], options = one[3] }
  end
  return cases
end

--- Fails if a process of these cases opened a file outside of the script's folder that is not the
--- system's. log: of strace.
local function check_opened(log)
  local count, seen = 0, { ["secret.wav"] = true }
  local own = { bench.folder .. "/in", workbench.build, "/usr/", "/lib", "/etc/ld.so.", "/proc/",
    "/dev/", "/sys/", bench.folder .. "/one.sh", bench.folder .. "/err.", "/etc/localtime" }
  for line in log:gmatch "[^\n]+" do
    local path = line:match 'open[%w]*%([^"]*"([^"]*)".* = %d+'
    if path then count = count + 1 end
    assert.falsy(path and seen[path:match "[^/]*$"], line)
    assert.falsy(line:find("connect%(.*= 0"), line)
    local is_own = not path or path:sub(1, 1) ~= "/"
    for _, start in ipairs(own) do
      is_own = is_own or path:sub(1, #start) == start
    end
    assert.is_true(is_own, line)
  end
  assert.is_true(count > 100)
end

--- Fails unless everything ends when celspan is killed, after it has become `count` processes.
local function kill_celspan(arguments, count)
  local marked = ("grep -ls 'SOUND_SPEC=%s' /proc/[0-9]*/environ"):format(bench.folder)
  local code, _, err = in_folder(
    "SOUND_SPEC='%s' PATH=\"%s/bin:$PATH\" '%s' %s & until [ $(%s | wc -l) -ge %d ]; do "
    .. "sleep 0.01; done; kill -9 $!; wait $!; for i in 1 2 3 4 5 6 7 8 9; do %s || exit 0; "
    .. "sleep 0.05; done; exit 1", bench.folder, bench.folder, workbench.absolute, arguments,
    marked, count, marked)
  assert.equal(0, code, err)
end

describe("a sound", function()
  local has_ffmpeg = present.program "ffmpeg"

  it("is found by its first bytes, and leads nowhere else", function()
    if not has_ffmpeg then return pending "there is no ffmpeg" end
    local has_strace = present.program "strace" and not present.sanitizer()
    write_files()
    local cases = all_cases()
    check_all(cases, has_strace
      and "strace -f -o ../log --seccomp-bpf -e trace=open,openat,openat2,connect")
    assert.is_true(#cases >= 60)
    for _, case in ipairs(cases) do
      local where = ("%s: exit code %d: %s"):format(case.name, case.code, case.err)
      if case.is_strange then
        assert.is_true(case.code == 0 or case.code == 4
          and case.err:find("the sound %S+ cannot be read: ") ~= nil, where)
      else
        assert.is_true(case.code == 4 or case.code == 3 or case.code == 6, where)
        assert.truthy(case.err:find(case.pattern), where)
      end
    end
    if has_strace then check_opened(bench:read "log") end
  end)

  it("that is a list of files is refused before a video is made of it", function()
    bench:write("secret.wav", tone())
    bench:write("in/film.wav", with_out(REFUSED["absolute.wav"]))
    local code, _, err = in_folder("'%s' render film.lua -o out.mkv --progress none -- film.wav",
      workbench.absolute)
    assert.equal(4, code, err)
    assert.truthy(err:find(NO_FORMAT), err)
    assert.same({ "film.lua", "film.wav" }, bench:files "in")
  end)

  it("that names a file with its samples has none", function()
    if not has_ffmpeg then return pending "there is no ffmpeg" end
    bench:write("secret.wav", tone())
    bench:write("in/film.m4a", external(bench.folder .. "/secret.wav", "M4A "))
    local code, _, err = in_folder("'%s' render film.lua -o out.mkv --progress none -- film.m4a",
      workbench.absolute)
    assert.equal(4, code, err)
    assert.truthy(err:find "cannot be read: ffmpeg ended", err)
  end)

  it("in an address is the same as in a file, also without --trust and with --strict", function()
    if not has_ffmpeg then return pending "there is no ffmpeg" end
    bench:write("in/tone.wav", tone())
    local address = "data:audio/wav," .. tone():gsub("[^%w]", function(c)
      return ("%%%02x"):format(c:byte())
    end)
    local mixes = {}
    address = "-- '" .. address .. "'"
    for i, one in ipairs { "-- tone.wav", address, "--strict " .. address,
      '-- "data:;base64,$(base64 -w 0 tone.wav)"' } do
      local code, _, err = in_folder("ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 '%s' sound "
        .. "film.lua -o mix.wav --progress none %s", workbench.absolute, one)
      assert.equal(0, code, err)
      mixes[i] = bench:read "in/mix.wav"
      assert.is_true(#mixes[i] > 48000 and mixes[i]:find("[^\0]", 100) ~= nil)
      assert.is_true(mixes[i] == mixes[1], one:sub(1, 30))
    end
  end)

  it("is refused with a sentence where no other program can be started", function()
    if not present.program "strace" then return pending "there is no strace" end
    bench:write("in/film.wav", tone())
    local code, _, err = in_folder("ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 strace -f "
      .. "-o ../calls -e inject=pipe2:error=ENOSYS '%s' sound film.lua -o mix.wav -- film.wav",
      workbench.absolute)
    assert.equal(5, code, err)
    assert.truthy(err:find "film.wav cannot be read: .* cannot start other programs", err)
  end)

  it("is silent where it has no samples, however slow or empty it is", function()
    if not has_ffmpeg then return pending "there is no ffmpeg" end
    for _, name in ipairs { "slow.wav", "nothing.wav" } do
      bench:write("in/" .. name, STRANGE[name])
      local code, _, err = in_folder("timeout -s KILL %d '%s' render film.lua -o out.mov "
        .. "--progress none -- %s && ffmpeg -v error -i out.mov -f s16le - | od -An -v -tx1 "
        .. "| tr -d ' 0\\n'",
        SECONDS, workbench.absolute, name)
      assert.equal(0, code, err)
      assert.equal("", bench:read "stdout")
    end
  end)
end)

describe("an ffmpeg that a sound has taken over", function()
  --- Runs celspan on a sound with this word for the hostile program. A leak check attaches to the
  --- process from another one, which --strict does not allow.
  local function check(word, arguments)
    bench:write("in/sound.ogg", "OggS\0\0\0\0" .. word)
    assert(os.execute(("cp '%s' '%s/bin/ffmpeg'"):format(HOSTILE, bench.folder)))
    return in_folder("ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 "
      .. "SOUND_SPEC='%s' PATH='%s/bin' '%s' check film.lua --deep %s",
      bench.folder, bench.folder, workbench.absolute, arguments or "-- sound.ogg")
  end
  --- The processes that were started from here and have not ended.
  local function left()
    return select(2, bench:shell(("grep -ls 'SOUND_SPEC=%s' /proc/[0-9]*/environ")
      :format(bench.folder)))
  end
  local function fails(word, code, pattern, arguments)
    local got, _, err = check(word, arguments)
    assert.equal(code, got, err)
    assert.truthy(err:find(pattern), err)
    assert.equal("", left())
    return err
  end

  it("can read the sound and the libraries, and do nothing else", function()
    assert(os.execute(("cp '%s' '%s/ffmpeg'"):format(HOSTILE, bench.folder)))
    local _, _, err = in_folder "../ffmpeg try 3<film.lua"
    assert.truthy(err:find "%d+ of 14", err)
    assert.is_true(tonumber(err:match "(%d+) of 14") >= 12, err)
    fails("try", 4, "exit code 1: 0 of 14\n")
    fails("try", 4, "exit code 1: 0 of 14\n", "--strict -- sound.ogg")
    fails("try", 4, "exit code 1: 0 of 14\n", "--trust -- sound.ogg")
  end)

  it("is ended at the limits", function()
    local limits = "--limit picture-time=0.3 -- sound.ogg"
    local late = "sound.ogg cannot be read: for 0.3 seconds no samples came of it.*picture%-time"
    fails("hang", 6, late, limits)
    fails("starve", 6, late, limits .. " 2")
    fails("shout", 6, late, limits .. " 2")
    if present.sanitizer() then return end
    fails("eat", 33, "needs more than 64 MiB, or than the system has %(%-%-limit picture%-memory",
      "--limit picture-memory=64M -- sound.ogg")
  end)

  it("is not trusted", function()
    fails("babble", 4, "its decoder sent invalid samples; it is damaged or malicious")
    fails("wide", 4, "its decoder sent invalid samples; it is damaged or malicious")
    fails("slow", 4, "its decoder sent invalid samples; it is damaged or malicious")
    assert.equal(0, (check "odd"))
    assert.equal(0, (check "long"))
  end)

  it("ends with everything that it has started", function()
    local code, _, err = check "fork"
    assert.equal(0, code, err)
    assert.equal("", left())
  end)

  it("ends when celspan is killed", function()
    check "babble"
    bench:write("in/sound.ogg", "OggS\0\0\0\0hang")
    kill_celspan("check film.lua --deep -- sound.ogg", 3)
  end)
end)

describe("the encoder", function()
  it("ends when celspan is killed", function()
    bench:write("bin/ffmpeg", "#!/bin/sh\nexec sleep 60\n")
    assert(os.execute(("chmod +x '%s/bin/ffmpeg'"):format(bench.folder)))
    kill_celspan("render film.lua --size 640x480 -o out.mkv --progress none", 2)
  end)
end)
