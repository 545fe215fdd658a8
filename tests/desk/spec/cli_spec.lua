-- The command line: its output and exit codes. One file, because all verbs share options, codes and
-- messages; verbs with more than that have files of their own.

local json = require "celspan.json"
local PLAIN = require "tests.support.plain_film"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local BINARY = workbench.binary
--- A limit of a program's memory; one with a sanitizer maps far more than it uses.
local BOUNDED = present.sanitizer() and "" or "ulimit -v 1000000; "

local bench, folder

local function read(path) return bench:read(path) end
local function write(name, text) return bench:write(name, text) end
local function shell(command) return bench:shell(command) end
local function celspan(arguments) return bench:shell("'" .. BINARY .. "' " .. arguments) end
local function files_in(path) return bench:files(path:sub(#folder + 2)) end

-- Large enough to be still running when a signal comes.
local LONG = [[
local celspan = require "celspan"
return celspan.film{ size = {100, 100}, frames = 100000, frame = function(f)
  return celspan.rostrum{ celspan.cel{ celspan.circle{ centre = {50, 50}, radius = 40 } } }
end }
]]

local it_reads_pictures = present.pictures() and it or pending

local function usage_error(arguments, pattern)
  local code, out, err = celspan(arguments)
  assert.equal(2, code, err)
  assert.equal("", out)
  assert.truthy(err:match("^celspan: error: [^\n]+\n$"), "one line: " .. err)
  assert.truthy(err:find(pattern, 1, true), err)
end

describe("the command line", function()
  local plain

  before_each(function()
    bench = workbench.new()
    folder = bench.folder
    plain = write("plain.lua", PLAIN)
  end)

  after_each(function() bench:remove() end)

  it("says that a limit of the stack is too low #plain", function()
    for kib, wanted in pairs { [64] = 33, [512] = 33, [1024] = 0 } do
      local code, _, err = shell(("ulimit -s %d; '%s' check %s"):format(kib, BINARY, plain))
      assert.equal(wanted, code, err)
      if wanted == 33 then
        assert.equal(("celspan: error: the stack is limited to %d KiB; at least 1024 are needed "
          .. "('ulimit -s' sets it)\n"):format(kib), err)
      end
    end
  end)

  describe("help", function()
    it("prints the version and the commit", function()
      local code, out, err = celspan("--version")
      assert.same({ 0, "" }, { code, err })
      assert.truthy(out:match("^celspan %d+%.%d+%.%d+ %(%w+%)\n$"), out)
    end)

    it("lists every verb, and has a page about each", function()
      local code, out = celspan("--help")
      assert.equal(0, code)
      for _, verb in ipairs { "render", "info", "check", "spans", "probe", "convert", "compare" } do
        assert.truthy(out:find("\n  " .. verb .. " ", 1, true), verb)
        local verb_code, text = celspan("help " .. verb)
        assert.equal(0, verb_code)
        assert.equal("celspan " .. verb .. " ", text:sub(1, 9 + #verb))
        assert.same({ 0, text, "" }, { celspan(verb .. " --help") })
      end
    end)

    --- The manual page by its headings, without escapes.
    local function sections_of(page)
      local sections, heading = {}, ""
      for line in page:gmatch "[^\n]*" do
        line = line:gsub("\\f[BIR]", ""):gsub("\\&", ""):gsub("\\(.)", { ["-"] = "-", e = "\\" })
        heading = line:match "^%.S[HS] (.*)" or heading
        sections[heading] = (sections[heading] or "") .. line .. "\n"
      end
      return sections
    end

    it("is a manual page that has every verb and option of the help, and no other", function()
      local code, page, err = celspan("--man")
      assert.same({ 0, "" }, { code, err })
      local sections, options = sections_of(page), 0
      for verb in select(2, celspan("help")):gmatch "\n  (%l+) +[%u|%[]" do
        local _, help = celspan("help " .. verb)
        local section, count = sections[help:match "^[^\n]+"] or "", 0
        for option in (help:match "\nOptions(\n.*)$" or ""):gmatch "\n  (%-[^\n]-)  " do
          count = count + 1
          assert.truthy(section:find("\n.TP\n" .. option, 1, true), verb .. " " .. option)
        end
        local _, listed = section:gsub("\n%.TP\n", "")
        assert.equal(count, listed, verb)
        options = options + count
      end
      assert.is_true(options > 40)
      local _, codes = sections["EXIT STATUS"]:gsub("\n%.TP\n", "")
      assert.equal(10, codes)
    end)

    it("is a manual page without faults", function()
      local page = write("celspan.1", (select(2, celspan("--man"))))
      if not present.program "mandoc" then return pending "there is no mandoc" end
      if (shell "man --version") ~= 0 then return pending "there is no man" end
      assert.same({ 0, "", "" }, { shell("mandoc -Tlint -W error " .. page) })
      local code, text, err = shell("LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l " .. page)
      assert.same({ 0, "" }, { code, err })
      assert.truthy(text:gsub(".\b", ""):find("--keep-going\n", 1, true), text:sub(1, 2000))
    end)

    --- The verbs and their options as the help prints them: { render = { "-o", ... }, ... }.
    local function listed()
      local verbs = {}
      for verb in select(2, celspan "help"):gmatch "\n  (%l+) +[%u|%[]" do
        verbs[verb] = verbs[verb] or {}
        local help = select(2, celspan("help " .. verb)):match "\nOptions(\n.*)$" or ""
        for option in help:gmatch "\n  (%-[%w-]+)" do table.insert(verbs[verb], option) end
      end
      return verbs
    end

    it("completes every verb and option in bash, and no other", function()
      if not present.program "bash" then return pending "there is no bash" end
      write("complete.sh", ([[
source <('%s' help --completion bash)
complete_words() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _celspan
  echo "$* = ${COMPREPLY[*]}"
}
complete_words celspan ""
for verb in ${COMPREPLY[@]}; do complete_words celspan $verb -; done
complete_words celspan render film.lua --frames -
complete_words celspan render film.lua -- -
complete_words celspan render film.lua --format a
]]):format(workbench.absolute))
      local code, out, err = shell(("bash '%s/complete.sh'"):format(folder))
      assert.same({ 0, "" }, { code, err })
      local all = listed()
      for verb in out:match "^celspan  = (.-)\n":gmatch "%S+" do
        local options = out:match("\ncelspan " .. verb .. " %- = (.-)\n")
        assert.equal(table.concat(all[verb] or {}, " "), options, verb)
        all[verb] = nil
      end
      assert.same({}, all)
      assert.truthy(out:find("\ncelspan render film.lua --frames - = \n", 1, true), out)
      assert.truthy(out:find("\ncelspan render film.lua -- - = \n", 1, true), out)
      assert.truthy(out:find("--format a = apng avif", 1, true), out)
    end)

    it("completes every verb and option in zsh and fish", function()
      for name, pattern in pairs {
        zsh = function(verb, option)
          return "\n    " .. verb .. "%) _arguments [^;]-'%*" .. option .. "%["
        end,
        fish = function(verb, option)
          local dash, letters = option:match "^(%%%-[%%%-]*)(.*)"
          return "from " .. verb .. "' " .. (#dash > 2 and "%-l " or "%-s ") .. letters .. " "
        end } do
        local code, text = celspan("help --completion " .. name)
        assert.equal(0, code)
        for verb, options in pairs(listed()) do
          for _, option in ipairs(options) do
            assert.truthy(text:find(pattern(verb, (option:gsub("%-", "%%-")))), verb .. option)
          end
        end
        if present.program(name) then
          local path = write("completion", text)
          assert.same({ 0, "", "" }, { shell(name .. " -n " .. path) })
        end
      end
      usage_error("help --completion tcsh", "'tcsh' is not bash, zsh or fish")
    end)

    it("shows the options of a verb, and no other's", function()
      local _, out = celspan("help render")
      assert.falsy(out:find("--stats", 1, true))
      assert.truthy(out:find("--frames LIST", 1, true))
    end)

    it("can be requested in several ways", function()
      local _, all = celspan "--help"
      for _, asked in ipairs { "help", "-h" } do assert.same({ 0, all, "" }, { celspan(asked) }) end
      local _, probe = celspan "help probe"
      assert.same({ 0, probe, "" }, { celspan "probe -h" })
      local code, near = celspan "help proeb"
      assert.equal(0, code)
      assert.truthy(near:find("\n    celspan help probe\n", 1, true), near)
    end)

    it("has pages about names of the Lua interface, and for others the nearest", function()
      local code, list, err = celspan "help lua"
      assert.same({ 0, "" }, { code, err })
      local _, page = celspan "help lua stroke"
      assert.truthy(list:find("\n  stroke ", 1, true))
      assert.truthy(page:find("celspan.stroke(fields)", 1, true))
      local near_code, near = celspan "help lua strok"
      assert.equal(0, near_code)
      assert.truthy(near:find("\n    celspan help lua stroke\n", 1, true), near)
    end)

    it("ends a recipe with how it is saved and run", function()
      local function last_of(recipe)
        local _, out = celspan("help " .. recipe)
        return (out:match "\n(Save it as .*)\n$":gsub("\n", " "))
      end
      local copied = "copy the folders drawings, pictures, stage and type beside it"
      assert.equal("Save it as three_depths.lua, and " .. copied,
        last_of("three_depths"):match "^(.-), from")
      assert.truthy(last_of("rolling_counter"):find(
        "'celspan play rolling_counter.lua --allow-system-fonts' shows it", 1, true))
      assert.truthy(last_of("plates"):find("'lua5.4 plates.lua' runs it.", 1, true))
      local alone = last_of "drop_shadow"
      assert.is_nil(alone:find(copied, 1, true) or alone:find("fonts", 1, true), alone)
    end)

    it("finds what is nearest to some words, and says where to read on", function()
      local code, found, err = celspan "help camera shake"
      assert.same({ 0, "" }, { code, err })
      assert.truthy(found:find("\n-- camera_shake.lua", 1, true), found)
      assert.same({ 0, found, "" }, { celspan "help camera_shake" })
      for _, asked in ipairs { "cross-hatching", "cross_hatching", "Cross hatching" } do
        local _, recipe = celspan("help " .. asked)
        assert.truthy(recipe:find("\n-- hatching.lua", 1, true), recipe)
      end
      for _, asked in ipairs { "help motion blur", "help lua 'motion blur'" } do
        local _, list = celspan(asked)
        assert.truthy(list:find('\n    docs/guide-picture.md, "Exposures"\n', 1, true), list)
        assert.truthy(list:find("\n    celspan help lua shutter\n", 1, true), list)
      end
      usage_error("help xyzzyxyzzy", "there is nothing about 'xyzzyxyzzy'; celspan help lists")
    end)

    it("is printed to standard error if no verb is given, the first commands before all", function()
      local code, out, err = celspan("")
      assert.equal(2, code)
      assert.equal("", out)
      local steps = "\n  celspan init .*\n  celspan watch .*\n  celspan render .*\n  render "
      assert.truthy(err:find(steps), err)
    end)
  end)

  it("lists the fonts that a film may read", function()
    assert(os.execute(("mkdir -p '%s/type/sub'"):format(folder)))
    bench:write("type/sub/one.ttf", "")
    bench:write("two.otf", "")
    bench:write("three.txt", "")
    local code, out = celspan("fonts '" .. plain .. "'")
    assert.equal(0, code)
    assert.truthy(out:find("^two.otf\ntype/sub/one.ttf\nwith %-%-allow%-system%-fonts:\n")
      or out:find("^type/sub/one.ttf\ntwo.otf\nwith "), out)
    assert.same({ "two.otf", "type/sub/one.ttf" }, (function(list)
      table.sort(list)
      return list
    end)(json.decode(select(2, celspan("fonts --json '" .. plain .. "'"))).fonts))
  end)

  it("says that a film is stretched", function()
    local command = ("render '%s' -o '%s/x.png' --frames 1 --size "):format(plain, folder)
    local _, _, err = celspan(command .. "50x100")
    assert.truthy(err:find("is stretched to 50x100; --fit contain or --fit cover keeps its shape",
      1, true), err)
    for _, more in ipairs { "50x100 --fit stretch", "64x32" } do
      _, _, err = celspan(command .. more)
      assert.falsy(err:find("stretched", 1, true), err)
    end
  end)

  describe("wrong usage", function()
    it("suggests the nearest verb and the nearest option", function()
      usage_error("rendr x.lua", "did you mean 'render'?")
      for word, verb in pairs { new = "init", preview = "watch", export = "render" } do
        usage_error(word .. " x.lua", ("unknown verb '%s': did you mean '%s'?"):format(word, verb))
      end
      usage_error("render x.lua", "-o is missing: give -o film.mp4 for a video, -o shot.####.png")
      usage_error("shots/a.lua --frames 1", "'shots/a.lua' is a script, and a verb is missing "
        .. "before it: 'celspan play shots/a.lua' shows it, 'celspan render shots/a.lua -o ")
      usage_error("cat.svg", "'cat.svg' is a file, and a verb is missing before it: "
        .. "'celspan info cat.svg' describes it")
      usage_error("render x.lua -o y.png --frmaes 1", "did you mean '--frames'?")
      usage_error("render x.lua -o y.png --nothing-like-it 1", "celspan help render")
      usage_error("xyzzyxyzzy x.lua", "unknown verb 'xyzzyxyzzy' ('celspan help' lists them)")
      usage_error("render x.lua -o y.png --" .. ("long"):rep(100), "unknown option '--longlong")
      usage_error("info x.lua '--parameters --json'", "unknown option '--parameters --json'")
      usage_error("check x.lua --word=Hi", "a parameter of the script is given by --set word=Hi")
    end)

    it("names the option, what was given and what is allowed", function()
      usage_error("render x.lua -o y.png --size 12", "--size: '12' is not width x height")
      usage_error("render x.lua -o y.png --size 0x4", "--size")
      usage_error("render x.lua -o y.png --size 4x1048577", "1048576")
      usage_error("render x.lua -o y.png --crop 1,2,3", "--crop: '1,2,3' is not four")
      usage_error("render x.lua -o y.png --scale -1", "--scale")
      usage_error("render x.lua -o y.png --scale nan", "--scale")
      usage_error("render x.lua -o y.png --depth 12", "8, 16, half or float")
      usage_error("render x.lua -o y.png --workers 0", "1 to 1024")
      usage_error("spans x.lua --rows 5-2", "--rows")
      usage_error("render x.lua -o y.png --hash=1", "--hash takes no value")
      usage_error("render x.lua -o", "-o needs a value")
      usage_error("render x.lua -o y.png --depth", "--depth needs a value: 8, 16, half or float")
    end)

    it("says which verb makes videos", function()
      usage_error("convert in.png out.mp4", "a video is made of numbered pictures or a movie")
      usage_error("convert in.png out.webm", "or by 'celspan render'")
    end)

    it("refuses impossible output files before it runs the script", function()
      usage_error("render x.lua -o y.xyz", 'the format "xyz" cannot be written')
      for _, more in ipairs { "png, tga, targa, span", "mp4, mkv, mov, webm", "plane", "wav" } do
        usage_error("render x.lua -o y.avi", more)
        usage_error("convert x.png y.heic", more)
      end
      for _, words in ipairs { "render x.lua -o y --format json", "convert x.png y.lottie" } do
        usage_error(words, words:find "json" and "json takes no --format: leave it out"
          or "lottie is for Lottie animations, which 'celspan render' makes")
      end
      usage_error("render x.lua y.mp4", "unexpected argument 'y.mp4': write '-o y.mp4' if that is")
      usage_error("render x.lua -o y", "the format is unknown")
      usage_error("render x.lua -o y.png --format xyz", 'the format "xyz" cannot be written')
      usage_error("render x.lua -o y.png --depth half", "PNG holds 8 or 16 bits")
      usage_error("convert x.png -", "- is for raw frames")
      usage_error("render x.lua -o - --format png", "standard output takes no --format")
    end)

    it("counts operands", function()
      usage_error("probe x.lua 1", "usage: celspan probe SCRIPT X Y")
      usage_error("info x.lua y.lua", "unexpected argument 'y.lua'")
      usage_error("convert a b -- c", "does not run one")
      usage_error("probe " .. plain .. " one 2", "X: 'one' is not a number")
      usage_error("probe " .. plain .. " 1 two", "Y: 'two' is not a number")
      for _, x in ipairs { "' 1'", "1x", "nan", "inf", "1e999", "''" } do
        usage_error("probe " .. plain .. " " .. x .. " 2",
          "X: '" .. x:gsub("'", "") .. "' is not a number")
      end
      usage_error("track x.png --at 1,2,3,4 -o y.lua", "track needs --from N and --at X,Y,W,H")
      usage_error("track x.png --from 1 -o y.lua", "track needs --from N and --at X,Y,W,H")
    end)

    it("refuses to guess", function()
      usage_error("render " .. plain, "-o shot.####.png")
      usage_error("render " .. plain .. " -o - --hash", "--hash")
      usage_error("render " .. plain .. " -o y.png --size 4x4 --scale 2", "--scale")
      usage_error("spans " .. plain .. " --pixels 8", "--stats")
    end)

    it("includes asking for frames that the film does not have", function()
      local one = folder .. "/one.png"
      usage_error("render " .. plain .. " -o " .. one, "for one, name it: --frames 1\n")
      usage_error("render " .. plain .. " -o " .. folder .. "/f.####.png --frames 12-13", "13")
      usage_error("render " .. plain .. " -o " .. folder .. "/f.####.png --frames 1-3,2", "2")
      usage_error("render " .. plain .. " -o " .. one .. " --frames 1 --crop 4,0,5,4", "8 x 4")
      usage_error("render " .. plain .. " -o " .. one .. " --frames 1 --crop 0,1,8,4", "8 x 4")
      usage_error("spans " .. plain .. " --frame 13", "13")
      usage_error("spans " .. plain .. " --rows 0-4", "rows 0 to 3")
      assert.is_nil(read(one))
    end)
  end)

  describe("failures", function()
    local function failure(expected, arguments, pattern)
      local code, out, err = celspan(arguments)
      assert.equal(expected, code, err)
      assert.equal("", out)
      assert.truthy(err:find("^celspan: error: "), err)
      assert.truthy(err:find(pattern, 1, true), err)
    end

    it("of a missing script end with 4", function()
      failure(4, "info " .. folder .. "/none.lua", "none.lua")
    end)

    it("of a script end with 3 and name file and line", function()
      failure(3, "info " .. write("syntax.lua", "\nreturn )"), "syntax.lua:2:")
      failure(3, "info " .. write("nothing.lua", "return 7"), "nothing.lua")
      local bad = write("bad.lua", PLAIN:gsub("local celspan", "local gone\nlocal celspan", 1)
        :gsub("%+ f%.index", "+ (f.number == 3 and gone.x or 0)"))
      failure(3, "render " .. bad .. " --progress none -o " .. folder .. "/f.##.png", "frame 3")
      failure(3, "spans " .. bad .. " --frame 3", "bad.lua:")
      assert.truthy(read(folder .. "/f.01.png") and read(folder .. "/f.02.png"))
      assert.is_nil(read(folder .. "/f.03.png"))
    end)

    it("of a compiled script include its name", function()
      failure(3, "info " .. write("binary.lua", string.dump(load "return 7")), "binary.lua: ")
    end)

    it_reads_pictures("of a picture end with 4", function()
      local script = write("picture.lua", [[
        local celspan = require "celspan"
        return celspan.rostrum{ celspan.cel{ celspan.image{ file = "no-such.png" } } }]])
      failure(4, "spans " .. script, "no-such.png")
      failure(4, "check " .. script, "no-such.png")
      failure(4, "convert " .. folder .. "/none.png " .. folder .. "/out.png", "none.png")
    end)

    it("of an output end with 5 and leave no files", function()
      write("file", "")
      failure(5, "render " .. plain .. " --progress none --frames 1 -o " .. folder .. "/file/f.png",
        "frame 1: ")
      assert.equal(5, (celspan("spans " .. plain .. " > /dev/full")))
      local code, _, err = celspan("render " .. plain
        .. " --frames 1 --progress none -o - > /dev/full")
      assert.same({ 5, 1 }, { code, select(2, err:gsub("\n", "")) }, err)
      for _, name in ipairs(files_in(folder)) do
        assert.falsy(name:find("%.part$"), name)
      end
    end)

    it_reads_pictures("to begin a file of any format end only with 5 or 6", function()
      write("file", "")
      for _, format in ipairs { "png", "exr", "tif", "tga", "dpx", "jpg", "span" } do
        failure(5, ("render %s --progress none --frames 1 -o %s/file/f.%s"):format(plain, folder,
          format), "frame 1: ")
      end
      failure(6, ("render %s --size 100000x1 --fit stretch --progress none --frames 1 -o %s/f.jpg")
        :format(plain, folder), "at most 65500")
    end)

    it("of an impossible picture size end with 6", function()
      failure(6, "render " .. write("tall.lua", (PLAIN:gsub("size = {8, 4}", "size = {1, 8}")))
        .. " --scale 2e5 --hash",
        "a frame of 1 x 8 at scale 200000 is more than 1048576 pixels a side")
      failure(6, "render " .. plain .. " --scale 1e6 --hash",
        "a frame of 8 x 4 at scale 1e+06 is more than 1048576 pixels a side: give a smaller")
      -- one pixel
      local tiny = " --scale 1e-9 --hash --frames 1 --progress none"
      assert.equal(0, (celspan("render " .. plain .. tiny)))
    end)

    it("of raw frames that nobody reads end with 5", function()
      local code, _, err = celspan("render " .. plain
        .. " --frames 1 --size 5000x100 --progress none -o - > /dev/full")
      assert.equal(5, code)
      assert.truthy(err:find("frame 1: standard output: No space left on device"), err)
    end)

    it("of a film that changes when its script runs again end with 3", function()
      local script = write("again.lua", ([[
        local celspan = require "celspan"
        local path, count = "%s/count", 0
        local file = io.open(path)
        if file then count = file:read "n" file:close() end
        file = assert(io.open(path, "w"))
        file:write(count + 1)
        file:close()
        return celspan.film{ size = {8, 4}, frames = 3 + count, frame = function()
          return celspan.rostrum{ celspan.cel{ celspan.rect{ 0, 0, 8, 4 } } } end
            }]]):format(folder))
      failure(3, "check --trust " .. script,
        "the script returned a film with other frames when it was run again: 4 from number 1, "
          .. "not 3 from number 1")
      local code, out, err = celspan("check --trust --json " .. script)
      assert.are.equal(3, code, err)
      assert.truthy(out:find('"message": "the script returned a film with other frames', 1, true),
        out)
      assert.is_nil(err:find("no faults", 1, true))
    end)

    -- Runs celspan with a pipe that nobody reads: its exit code and what it says.
    local function unread(arguments)
      local gone = ("%s/gone"):format(folder)
      shell(("rm -f %s; { while [ ! -e %s ]; do sleep 0.01; done; '%s' %s 2>%s/said; "
        .. "echo $? >%s/code; } | { exec <&-; : >%s; }"):format(gone, gone, BINARY, arguments,
        folder, folder, gone))
      return tonumber(read(folder .. "/code")), read(folder .. "/said")
    end

    it("of a closed pipe end with 5 and not with a signal, for text without a message", function()
      for _, arguments in ipairs { "spans " .. plain .. " --size 8x20000", "info " .. plain,
        "probe " .. plain .. " 1 1", "sheet " .. plain, "help render", "help lua cel", "--man",
        "render --progress none --hash --frames 1 " .. plain } do
        local code, message = unread(arguments)
        assert.same({ arguments, 5, "" }, { arguments, code, message })
      end
      local code, message = unread("render --progress none --frames 1 -o - " .. plain)
      assert.equal(5, code)
      assert.truthy(message:find("frame 1: standard output: Broken pipe", 1, true), message)
    end)
  end)

  -- The libraries that a run opens, as the dynamic linker reports.
  local function libraries(arguments)
    local code, _, err = shell("LD_DEBUG=files '" .. BINARY .. "' " .. arguments)
    assert.equal(0, code)
    assert.truthy(err:find("libc.so", 1, true), "the dynamic linker prints nothing")
    return err
  end

  describe("OpenImageIO", function()
    it("is not loaded for a film without pictures", function()
      for _, arguments in ipairs { "--hash --frames 1",
        "--frames 1-2 -o " .. folder .. "/f.#.png" } do
        local opened = libraries("render " .. plain .. " --progress none " .. arguments)
        assert.falsy(opened:find "OpenImageIO" or opened:find "celspan%-picture")
      end
    end)

    it("and others except Lua, zlib and the C library are not loaded for small scripts", function()
      local opened = libraries("render " .. plain .. " --progress none --hash --frames 1")
      local expected = { ["libc"] = true, ["libm"] = true, ["libz"] = true, ["liblua5.4"] = true }
      for name in opened:gmatch "calling init: %S*/(%S-)%.so" do
        local is_sanitizer = name:find "san$" or name == "libgcc_s" or name == "libstdc++"
        assert.truthy(expected[name] or is_sanitizer or name:find "^ld%-linux", name)
      end
    end)

    it_reads_pictures("is loaded with the first file that needs it", function()
      local opened = libraries("render " .. plain .. " --progress none --trust --frames 1 -o "
        .. folder
        .. "/f.exr")
      assert.truthy(opened:find "OpenImageIO" and opened:find "celspan%-picture")
      opened = libraries("render " .. plain .. " --progress none --frames 1 -o " .. folder
        .. "/f.exr")
      local own = opened:match "(%d+):" -- each line begins with the number of its process
      assert.falsy(opened:find(own .. ":[^\n]*OpenImageIO"), "a separate process loads it")
    end)
  end)

  describe("render", function()
    it("writes numbered frames into folders that it makes", function()
      local code, out, err = celspan("render " .. plain .. " -o " .. folder
        .. "/new/deep/f.####.png --frames 2-4,9-11:2 --progress none")
      assert.equal(0, code, err)
      assert.same({ "", "" }, { out, err })
      assert.same({ "f.0002.png", "f.0003.png", "f.0004.png", "f.0009.png", "f.0011.png" },
        files_in(folder .. "/new/deep"))
      assert.equal("\137PNG", read(folder .. "/new/deep/f.0002.png"):sub(1, 4))
    end)

    it("accepts printf patterns, and a run of # that grows with the number", function()
      celspan("render " .. plain .. " -o " .. folder .. "/p%03d.png --frames 7 --progress none")
      assert.truthy(read(folder .. "/p007.png"))
      celspan("render " .. plain .. " -o " .. folder .. "/g#.png --frames 9-10 --progress none")
      assert.truthy(read(folder .. "/g9.png"))
      assert.truthy(read(folder .. "/g10.png"))
    end)

    it("writes one frame under a plain name, replacing an existing file", function()
      local path = write("one.png", "old")
      local code, _, err = celspan("render " .. plain .. " -o " .. path
        .. " --frames 5 --progress none")
      assert.equal(0, code, err)
      assert.equal("\137PNG", read(path):sub(1, 4))
    end)

    it("prints a line per frame on request, only to standard error", function()
      local code, out, err = celspan("render " .. plain .. " -o " .. folder
        .. "/f.#.png --frames 1-4 --progress lines")
      assert.equal(0, code, err)
      assert.equal("", out)
      local lines = 0
      for line in err:gmatch("[^\n]+") do
        lines = lines + 1
        assert.truthy(line:find("^celspan: "), line)
      end
      assert.equal(5, lines)
      assert.truthy(err:find("(2 of 4, 50 %)", 1, true), err)
    end)

    it("draws a bar on request, and removes it", function()
      local code, out, err = celspan("render " .. plain .. " -o " .. folder
        .. "/f.#.png --progress bar")
      assert.equal(0, code)
      assert.equal("", out)
      assert.truthy(err:match("12 frames in 0:%d%d %(100 %%%)\n$"), err)
    end)

    local SLOW = PLAIN:gsub("return celspan%.rostrum", "os.execute('sleep %%s') %0")
      :gsub("frames = 12", "frames = 3")

    it("draws the bar in a terminal, no wider than the terminal", function()
      local slow = write("slow.lua", SLOW:format "0.12")
      for columns, left in pairs { [0] = "] +%d+ %%  frame 2 of 3", [20] = "" } do
        local code, out =
          shell(("script -qec 'stty cols %d; \"%s\" render --trust %s --hash' /dev/null </dev/null")
          :format(columns, BINARY, slow))
        assert.equal(0, code, out)
        local bar = out:match("%[#[#.]*" .. left)
        assert.truthy(bar, out)
        if columns > 0 then assert.equal(columns - 1, #bar) end
        assert.falsy(out:find("frame 1:", 1, true), out)
      end
    end)

    it("shows a remaining time of a second or more", function()
      local slow = write("slow.lua",
        (SLOW:format("1.02"):gsub("os%.execute", "local _ = f.number == 1 and %0")))
      local code, _, err = celspan("render --trust " .. slow
        .. " --hash --frames 1-2 --progress lines")
      assert.equal(0, code, err)
      assert.truthy(err:find("frame 1: [^\n]*%(1 of 2, 50 %%, 0:0%d left%)\n"), err)
    end)

    it("writes only raw frames to standard output", function()
      local code, out, err = celspan("render " .. plain .. " -o - --frames 1-2 --progress none")
      assert.equal(0, code, err)
      assert.equal(2 * 8 * 4 * 4, #out)
      assert.equal("\255\0\0\255", out:sub(1, 4))
      assert.equal("\0\0\255\64", out:sub(29, 32))
    end)

    it("codes raw frames as requested", function()
      local raw = "render " .. plain .. " -o - --frames 1 --progress none "
      local _, deep = celspan(raw .. "--depth 16 --crop 7,3,1,1")
      assert.same({ 0, 0, 65535, 16384, 9 }, { string.unpack("<I2I2I2I2", deep) })
      local _, linear = celspan(raw .. "--depth float --crop 7,0,1,1")
      local r, g, b, a = string.unpack("<ffff", linear)
      assert.same({ 0, 0, 0.25, 0.25 }, { r, g, b, a })
      local _, premultiplied = celspan(raw
        .. "--crop 7,0,1,1 --alpha premultiplied --colour linear")
      assert.equal("\0\0\64\64", premultiplied)
    end)

    it("makes a crop with the same bytes as that part of the whole", function()
      local raw = "render " .. plain .. " -o - --frames 1 --progress none --size 16x8 "
      local _, whole = celspan(raw)
      local _, crop = celspan(raw .. "--crop 3,2,9,4")
      local rows = {}
      for y = 2, 5 do
        rows[#rows + 1] = whole:sub(4 * (16 * y + 3) + 1, 4 * (16 * y + 12))
      end
      assert.equal(4 * 9 * 4, #crop)
      assert.equal(table.concat(rows), crop)
    end)

    it("does not let a script print to standard output", function()
      local script = write("talk.lua", "print('one', 2)\nio.write('three')\n" .. PLAIN)
      local _, quiet = celspan("render " .. plain .. " -o - --frames 1 --progress none")
      local code, out, err = celspan("render " .. script
        .. " -o - --frames 1 --progress none --trust")
      assert.same({ 0, quiet, "one\t2\nthree" }, { code, out, err })
      code, out, err = celspan("render " .. write("says.lua", "print('one', 2)\n" .. PLAIN)
        .. " -o - --frames 1 --progress none")
      assert.same({ 0, quiet, "one\t2\n" }, { code, out, err })
    end)

    it("cannot be ended with success by its script", function()
      local path = write("exit.lua", "os.exit(0)")
      local code, _, err = celspan("info " .. path)
      assert.equal(3, code)
      assert.truthy(err:find("exit.lua:1: os is not in the sandbox", 1, true), err)
      code, _, err = celspan("info --trust " .. path)
      assert.equal(3, code)
      assert.truthy(err:find("exit.lua:1: os.exit", 1, true), err)
    end)

    it("scales the film", function()
      local _, out = celspan("render " .. plain .. " -o - --frames 1 --progress none --scale 2.5")
      assert.equal(20 * 10 * 4, #out)
    end)

    it("prints the same digests for any number of workers #workers", function()
      local command = "render " .. plain .. " --hash --size 500x300 --progress none --workers "
      local code, one = celspan(command .. "1")
      assert.equal(0, code)
      local _, four = celspan(command .. "4")
      assert.equal(one, four)
      local count = 0
      for number, digest in one:gmatch("(%d+) (%x+)\n") do
        count = count + 1
        assert.equal(count, tonumber(number))
        assert.equal(32, #digest)
      end
      assert.equal(12, count)
      assert.equal(one:match("^[^\n]+\n"), (select(2, celspan(command .. "2 --frames 1"))))
    end)

    it("prints the digest of its output", function()
      local options = " --hash --frames 3-4 --depth 16 --progress none"
      local _, alone = celspan("render " .. plain .. options)
      local code, written, err = celspan("render " .. plain .. options .. " -o " .. folder
        .. "/f.##.png")
      assert.same({ 0, alone, "" }, { code, written, err })
      assert.truthy(read(folder .. "/f.03.png") and read(folder .. "/f.04.png"))
      local _, eight = celspan("render " .. plain .. (options:gsub("16", "8")))
      assert.are_not.equal(alone, eight)
    end)

    it("leaves no files if hashed frames cannot be written or made", function()
      write("file", "")
      assert.equal(5, (celspan("render " .. plain .. " --hash --progress none --frames 1 -o "
        .. folder .. "/file/f.png")))
      local script = write("singular.lua", [[
        local celspan = require "celspan"
        return celspan.rostrum{ celspan.cel{}, camera = { width = 1e-300 } }]])
      local code, _, err = celspan("render " .. script .. " --hash -o " .. folder .. "/new/s.png")
      assert.equal(3, code, err)
      assert.same({}, files_in(folder .. "/new"))
    end)

    it("passes arguments after -- to the script", function()
      local script = write("arguments.lua", [[
        local celspan = require "celspan"
        local width, name = ...
        assert(name == "--size", name)
        return celspan.film{ size = {tonumber(width), 1}, frames = 1, frame = function()
          return celspan.rostrum{ celspan.cel{ celspan.rect{ 0, 0, 1, 1 } } } end }]])
      local code, out, err = celspan("render " .. script .. " -o - --progress none -- 5 --size")
      assert.equal(0, code, err)
      assert.equal(5 * 4, #out)
    end)

    it("ends a script that ignores a signal", function()
      local script = write("loop.lua", "while true do pcall(function() while true do end end) end")
      local code, out, err = shell("'" .. BINARY .. "' info " .. script
        .. " & pid=$!; sleep 0.2; kill -TERM $pid; wait $pid; exit $?")
      assert.same({ 143, "" }, { code, out }, err)
    end)

    it("stops at a signal, dies by it and leaves no incomplete frame", function()
      local script = write("long.lua", LONG)
      local code, _, err = shell("'" .. BINARY .. "' render " .. script
        .. " --size 4000x4000 --progress none -o "
        .. folder .. "/out/f.####.png & pid=$!; sleep 0.5; kill -TERM $pid; wait $pid; exit $?")
      assert.equal(143, code, err)
      for _, name in ipairs(files_in(folder .. "/out")) do
        assert.truthy(name:find("^f%.%d+%.png$"), name)
      end
    end)
  end)

  describe("spans", function()
    it("prints one line per span", function()
      local code, out, err = celspan("spans " .. plain .. " --rows 0-1")
      assert.equal(0, code, err)
      assert.equal("0 0 4 single 1 0 0 1\n0 4 8 single 0 0 0.25 0.25\n"
        .. "1 0 4 single 1 0 0 1\n1 4 8 single 0 0 0.25 0.25\n", out)
    end)

    it("prints the requested rows and frame", function()
      local _, out = celspan("spans " .. plain .. " --frame 3 --rows 3-3 --antialias none")
      assert.equal("3 0 6 single 1 0 0 1\n3 6 8 single 0 0 0.25 0.25\n", out)
    end)

    it("prints the first and the last pixel of a gradient", function()
      local script = write("gradient.lua", [[
        local celspan = require "celspan"
        local ramp = celspan.linear{ from = {0, 0}, to = {8, 0}, {0, celspan.rgb(0, 0, 0)}, {1,
          celspan.rgb(1, 1, 1)} }
        return celspan.film{ size = {8, 1}, frames = 1, frame = function()
          return celspan.rostrum{ celspan.cel{ celspan.rect{ 0, 0, 8, 1, texture = ramp } } } end
            }]])
      local _, out = celspan("spans " .. script .. " --antialias none")
      assert.equal("0 0 8 gradient 0.0625 0.0625 0.0625 1 0.9375 0.9375 0.9375 1\n", out)
    end)

    local STATISTICS = "^rows (%d+) spans (%d+) single (%d+) gradient (%d+) array (%d+) "
      .. "pixels_in_arrays (%d+) maps (%d+) maps_made (%d+) swept (%d+) rows_held (%d+) "
      .. "colour_evaluations (%d+) "
      .. "allocations (%d+) peak_bytes (%d+) bands_made (%d+) bands_found (%d+) "
      .. "bands_bytes (%d+) seconds (%d+%.%d+)\ncels: (%d+) drawn from kept maps, (%d+) from new "
      .. "maps, (%d+) swept; rows: (%d+) made, (%d+) taken from held bands; "
      .. "rows of blurs: (%d+) made, (%d+) found again, (%d+%.%d) MiB kept\n$"

    it("counts spans by kind", function()
      local code, out, err = celspan("spans " .. plain .. " --stats")
      assert.equal(0, code, err)
      local rows, spans, single, gradient, array, pixels = out:match(STATISTICS)
      assert.same({ "4", "8", "8", "0", "0", "0" },
        { rows, spans, single, gradient, array, pixels }, out)
    end)

    it("counts the bands of defocused cels that it keeps", function()
      local script = write("soft.lua", [[
        local celspan = require "celspan"
        local disc = celspan.circle{ centre = {32, 32}, radius = 16, texture = "#fff" }
        return celspan.film{ size = {64, 64}, frames = 1, frame = function()
          return celspan.rostrum{ celspan.cel{ disc, defocus = 5 } } end }]])
      local _, soft = celspan("spans " .. script .. " --stats")
      local _, sharp = celspan("spans " .. plain .. " --stats")
      local made, _, bytes = select(14, soft:match(STATISTICS))
      assert.is_true(tonumber(made) >= 2 and tonumber(bytes) > 64 * 16, soft)
      local kept, new, swept, rows, held, made_again = select(18, soft:match(STATISTICS))
      assert.same({ "0", "0", "1", "64", "0", made }, { kept, new, swept, rows, held, made_again },
        soft)
      assert.truthy(sharp:find("bands_made 0 bands_found 0 bands_bytes 0 ", 1, true), sharp)
    end)

    it("counts the same if rows are made as pixels", function()
      local _, counted = celspan("spans " .. plain .. " --stats --size 100x50")
      for _, depth in ipairs { "8", "16", "half", "float" } do
        local code, out = celspan("spans " .. plain .. " --stats --size 100x50 --pixels " .. depth)
        assert.equal(0, code)
        assert.same({ select(2, counted:find(" array %d+")) },
          { select(2, out:find(" array %d+")) })
        assert.truthy(out:match(STATISTICS), out)
      end
    end)

    it("prints the same with any number of workers #workers", function()
      local _, one = celspan("spans " .. plain .. " --size 99x77 --workers 1")
      local _, four = celspan("spans " .. plain .. " --size 99x77 --workers 4")
      assert.truthy(one:find("^0 0 "))
      assert.equal(one, four)
    end)
  end)

  describe("probe", function()
    it("prints one colour", function()
      assert.same({ 0, "1 0 0 1\n", "" }, { celspan("probe " .. plain .. " 1 1") })
      assert.same({ 0, "0 0 0.25 0.25\n", "" }, { celspan("probe " .. plain .. " 7.5 1") })
      assert.same({ 0, "1 0 0 1\n", "" }, { celspan("probe " .. plain .. " --frame 12 7.5 1") })
    end)

    it("accepts negative coordinates", function()
      assert.same({ 0, "0 0 0 0\n", "" }, { celspan("probe " .. plain .. " -1 -.5") })
    end)
  end)

  describe("check", function()
    it("prints nothing about a film without faults", function()
      local code, out, err = celspan("check " .. plain)
      assert.equal(0, code, err)
      assert.equal("", out)
      assert.truthy(err:find("12 frames checked: no faults", 1, true), err)
    end)

    it("shows once what the script prints", function()
      local path = write("talks.lua", [[
local celspan = require "celspan"
print "begin"
return celspan.film { size = { 4, 4 }, frames = 2, frame = function(f)
  print(f.number)
  return celspan.rostrum {}
end }]])
      for _, options in ipairs { "", "--trust " } do
        local code, _, err = celspan("check " .. options .. path)
        assert.are.equal(0, code)
        assert.are.equal("begin\n1\n2\n", err:match "^begin.-2\n")
        assert.is_nil(err:find("begin", 2, true))
      end
    end)

    it("prints faults as JSON", function()
      local script = write("faulty.lua", (PLAIN:gsub("return celspan%.rostrum",
        "if f.number > 9 then error 'no' end\n  %0")))
      local code, out, err = celspan("check --json " .. script)
      assert.equal(3, code, err)
      local list = json.decode(out)
      assert.equal(1, #list)
      assert.truthy(list[1].message:find(":%d+: no$"), out)
      assert.same({ 10, "10-12", script }, { list[1].frame, list[1].frames, list[1].file })
      local none = { celspan("check --json " .. plain) }
      assert.same({ 0, "[]\n" }, { none[1], none[2] })
      code, out = celspan("check --json " .. write("torn.lua", "local x = = 3"))
      assert.equal(3, code)
      assert.equal(1, json.decode(out)[1].line)
    end)

    it("finds frame functions that are not pure", function()
      local script = write("impure.lua",
        (PLAIN:gsub("local celspan", "local n = 0\nlocal celspan", 1)
        :gsub("return celspan%.rostrum", "n = n + 1\n  return celspan.rostrum")
        :gsub("f%.index", "n")))
      local code, _, err = celspan("check " .. script)
      assert.equal(3, code, err)
      assert.truthy(err:find("is not pure", 1, true), err)
      code, _, err = celspan("check " .. script .. " --frames 2")
      assert.equal(3, code, err)
      assert.truthy(err:find("frame 2: the frame function is not pure", 1, true), err)
    end)

    --- A film that writes a letter into a file for each frame that it builds.
    local function counted(frames, more)
      return write("counted.lua", ([[
        local celspan = require "celspan"
        local path, calls = ..., 0
        return celspan.film{ size = {8, 4}, frames = %d, frame = function(f)
          calls = calls + 1
          local count <close> = io.open(path, "a")
          count:write "x"
          %s
          return celspan.rostrum{ celspan.cel{ celspan.rect{ 0, 0, f.number, 4 } } }
        end }]]):format(frames, more or ""))
    end

    --- How many frames are built, and what is said.
    local function builds(frames, more)
      os.remove(folder .. "/count")
      local _, _, err = celspan(("check --trust %s -- %s/count"):format(counted(frames, more),
        folder))
      return #read(folder .. "/count"), err
    end

    it("builds each frame once, and a tenth of them, nine at least, again", function()
      for frames, again in pairs { [1] = 6, [2] = 6, [9] = 9, [90] = 9, [144] = 15, [240] = 24 } do
        local count, err = builds(frames)
        assert.equal(frames + again, count, err)
        assert.truthy(err:find(" checked: no faults", 1, true), err)
      end
      assert.same({ builds(9000) }, { builds(9000) })
    end)

    it("builds all again if one of these differs, and names every frame that does", function()
      local count, err = builds(100, "if f.number >= 60 and calls ~= f.number then error() end")
      assert.is_true(count >= 200 and count < 210, count)
      assert.truthy(err:find("frames 60-100: the frame function is not pure", 1, true), err)
    end)

    it("says which frame is the slowest to build, if it is slow", function()
      local _, err = builds(2, [[local began = os.clock()
        repeat until f.number == 1 or os.clock() > began + 0.26]])
      assert.truthy(err:find("celspan: slowest to build: frame 2, %d+%.%d s; %d+%.%d s for a frame "
        .. "on average\n"), err)
      _, err = builds(2)
      assert.is_nil(err:find "slowest")
    end)

    it("does not report procedures that are new in each frame as a fault", function()
      local script = write("procedure.lua", [[
        local celspan = require "celspan"
        return celspan.film{ size = {8, 4}, frames = 3, frame = function(f)
          return celspan.rostrum{ celspan.cel{ celspan.rect{ 0, 0, 8, 4 } - celspan.scanline{
            bounds = {0, 0, 8, 4}, spans = function(y) return { {0, y, "#f00"} } end } } }
        end }]])
      local code, _, err = celspan("check " .. script)
      assert.equal(0, code, err)
    end)

    it_reads_pictures("continues after a fault and reports each once", function()
      local script = write("faults.lua", [[
        local celspan = require "celspan"
        return celspan.film{ size = {8, 4}, frames = 6, frame = function(f)
          if f.number == 2 then error("the second is missing") end
          if f.number == 5 then return 7 end
          return celspan.rostrum{ celspan.cel{
            celspan.image{ file = "gone.png", w = 3, h = 3 }, celspan.rect{ 0, 0, 8, 4 } } }
        end }]])
      local code, _, err = celspan("check " .. script)
      assert.equal(4, code, err)
      assert.truthy(err:find("the second is missing", 1, true), err)
      assert.truthy(err:find("frame 5", 1, true), err)
      local _, mentions = err:gsub("gone%.png", "")
      assert.equal(1, mentions, err)
    end)
  end)

  describe("check of many faults", function()
    local function film(frames, body)
      return write("many.lua", ([[
        local celspan = require "celspan"
        return celspan.film{ size = {8, 4}, frames = %d, frame = function(f)
          local n = f.number
          %s
          return celspan.rostrum{ celspan.cel{ celspan.rect{ 0, 0, n, 4 } } }
        end }]]):format(frames, body))
    end

    it("combines the frames that share one into a line", function()
      local script = film(30, [[if n > 2 and n < 18 or n == 20 then error "bad" end
        if n == 7 or n == 25 then error("bad " .. n) end]])
      local code, out, err = celspan("check " .. script)
      assert.same({ 3, "" }, { code, out })
      assert.equal(("celspan: error: frames 3-17, 20: %s:4: bad\n"):format(script)
        .. ("celspan: error: frame 25: %s:5: bad 25\n"):format(script)
        .. "celspan: 2 faults, found 17 times in 30 frames\n", err)
    end)

    it("lists a few runs of frames and counts the rest", function()
      local script = film(9000, "if n % 2 == 1 then error 'odd' end")
      local _, _, err = celspan("check " .. script)
      assert.equal(("celspan: error: frames 1, 3, 5, 7, 9, 11, 13, 15 and 4492 more up to 8999: "
        .. "%s:4: odd\ncelspan: 1 fault, found 4500 times in 9000 frames\n"):format(script), err)
    end)

    it("joins the runs of parts that are checked in both directions", function()
      local script = write("impure.lua", [[
        local celspan = require "celspan"
        local sum = 0
        return celspan.film{ size = {8, 4}, frames = 9000, frame = function(f)
          sum = sum + f.number
          return celspan.rostrum{ celspan.cel{ celspan.rect{ 0, sum / 2, 5, 4 } } }
        end }]])
      local code, _, err = celspan("check " .. script)
      assert.equal(3, code)
      assert.truthy(err:find("error: frames 1-9000: the frame function is not pure", 1, true), err)
    end)

    it("lists at most a thousand sentences", function()
      local script = film(1500, "error('bad ' .. n)")
      local _, _, err = celspan("check " .. script)
      local _, lines = err:gsub("\n", "")
      assert.equal(1002, lines)
      assert.truthy(err:find("frame 1000: " .. script .. ":4: bad 1000\n"
        .. "celspan: error: 500 more faults with other sentences are not listed: check fewer "
        .. "frames at a time, with --frames\n"
        .. "celspan: more than 1000 faults, found 1500 times in 1500 frames\n", 1, true),
        err:sub(-400))
    end)

    it("checks only the frames of --frames", function()
      local script = film(30, "if n == 7 then error 'bad' end")
      assert.equal(0, (celspan("check " .. script .. " --frames 1-6,8-30:2")))
      local _, _, err = celspan("check " .. script .. " --frames 8,7,6")
      assert.equal(("celspan: error: frame 7: %s:4: bad\n"):format(script)
        .. "celspan: 1 fault, found 1 time in 3 frames\n", err)
      usage_error("check " .. script .. " --frames 31", "31")
    end)

    it("needs no memory for the frames of a long film, and reports so far when it is stopped",
      function()
        local begun = folder .. "/begun"
        local script = film(100000000, ("if n == 100 then io.open(%q, 'w'):close() end "
          .. "if n %% 2 == 0 then error 'even' end"):format(begun))
        local code, _, err = shell(BOUNDED .. "'" .. BINARY .. "' check --trust " .. script
          .. " & pid=$!; until [ -e " .. begun .. " ]; do sleep 0.1; done; kill -TERM $pid; "
          .. "wait $pid; exit $?")
        assert.equal(143, code, err)
        assert.truthy(err:match("^celspan: error: frames 2, 4, 6, 8, 10, 12, 14, 16 and "
          .. "%d+ more up "
          .. "to %d+: [^\n]+:4: even\ncelspan: stopped after %d+ of 100000000 frames\n"), err)
      end)
  end)

  describe("check of pictures", function()
    local function film(body)
      return write("pictures.lua", [[
        local celspan = require "celspan"
        local function slide(file) return celspan.image{ file = file, w = 3, h = 3 } end
        return celspan.film{ size = {8, 4}, frames = 3, frame = function(f)
          ]] .. body .. " end }")
    end

    it_reads_pictures("reports all faults of a frame, each with its cel and primitive", function()
      write("broken.png", "this is no picture")
      local script = film([[return celspan.rostrum{
        celspan.cel{ celspan.rect{ 0, 0, 8, 4 }, slide "a.png" - slide "b.png" },
        celspan.cel{ slide "broken.png", slide(f.number == 2 and "c.png" or "a.png") } }]])
      local function at(line) return ("(%s:%d)"):format(script, line) end
      local code, _, err = celspan("check " .. script)
      assert.equal(4, code)
      local gone = "cannot be opened: No such file or directory\n"
      assert.equal(("celspan: error: frames 1-3: cel 1 %s, primitive 2 %s, and "
        .. "elsewhere: %s/a.png: "
        .. gone .. "celspan: error: frames 1-3: cel 1 %s, primitive 3 %s: %s/b.png: " .. gone
        .. "celspan: error: frames 1-3: cel 2 %s, primitive 1 %s: %s/broken.png: is not a "
        .. "picture of a "
        .. "known format (png, tiff, openexr, jpeg, targa, dpx, cineon, psd, bmp, webp, gif, hdr, "
        .. "pnm, jpeg2000, sgi)\ncelspan: error: frame 2: cel 2 %s, primitive 2 %s: %s/c.png: "
        .. gone
        .. "celspan: 4 faults, found 12 times in 3 frames\n")
        :format(at(5), at(2), folder, at(5), at(2), folder, at(6), at(2), folder, at(6), at(2),
        folder), err)
    end)

    it_reads_pictures("reads them completely with --deep", function()
      local whole = folder .. "/whole.tif"
      assert.equal(0,
        (celspan("render " .. plain .. " --progress none --frames 1 --size 300x200 -o "
        .. whole)))
      local bytes = read(whole)
      write("cut.tif", bytes:sub(1, #bytes - 10))
      local script =
        film [[return celspan.rostrum{ celspan.cel{ slide "whole.tif", slide "cut.tif" } }]]
      local header_code = celspan("check " .. script)
      local code, _, err = celspan("check --deep " .. script)
      assert.equal(4, code, err)
      assert.truthy(err:find("error: frames 1-3: cel 1 (" .. script .. ":4), primitive 2 ("
        .. script .. ":2): "
        .. folder .. "/cut.tif: ", 1, true), err)
      assert.is_nil(err:find("whole.tif", 1, true))
      assert.equal(0, header_code)
    end)
  end)

  describe("convert and compare", function()
    local function png(name, frame)
      local path = folder .. "/" .. name
      local code, _, err = celspan("render " .. plain .. " --progress none --frames " .. frame
        .. " -o " .. path)
      assert.equal(0, code, err)
      return path
    end

    it_reads_pictures("keep every coded value of a PNG", function()
      local a, b = png("a.png", 1), folder .. "/b.png"
      local code, out, err = celspan("convert " .. a .. " " .. b)
      assert.equal(0, code, err)
      assert.same({ "", "" }, { out, err })
      assert.same({ 0, "largest_difference 0 pixels_differing 0 pixels 32\n", "" },
        { celspan("compare " .. a .. " " .. b) })
    end)

    it_reads_pictures(
      "print the largest difference, its position and how many pixels differ", function()
      local a, b = png("a.png", 1), png("b.png", 2)
      local code, out = celspan("compare " .. a .. " " .. b)
      assert.equal(1, code)
      assert.equal("largest_difference 1 x 4 y 0 channel r pixels_differing 4 pixels 32\n", out)
      assert.equal(0, (celspan("compare " .. a .. " " .. b .. " --fail 1")))
      assert.equal(1, (celspan("compare " .. a .. " " .. b .. " --fail 0.99")))
    end)

    it_reads_pictures("report different sizes", function()
      local a, b = png("a.png", 1), folder .. "/b.png"
      assert.equal(0, (celspan("convert " .. a .. " " .. b .. " --crop 4,1,3,2")))
      assert.same({ 1, "sizes_differ 8x4 3x2\n", "" }, { celspan("compare " .. a .. " " .. b) })
    end)

    it_reads_pictures("resize", function()
      local a, b = png("a.png", 1), folder .. "/b.png"
      assert.equal(0, (celspan("convert " .. a .. " " .. b .. " --size 4x2")))
      local _, out = celspan("compare " .. a .. " " .. b)
      assert.equal("sizes_differ 8x4 4x2\n", out)
    end)
  end)

  describe("started with closed descriptors", function()
    it("renders the same frames, and writes no message into a frame", function()
      local script = write("said.lua", "print('said by the script')\n" .. PLAIN)
      local function rendered(name, closed)
        local path = folder .. "/" .. name
        assert.equal(0, (celspan("render " .. script .. " -o " .. path .. " --frames 1" .. closed)))
        return read(path)
      end
      local right = rendered("open.tga", "")
      assert.equal(right, rendered("no-error.tga", " 2>&-"))
      assert.equal(right, rendered("none.tga", " <&- >&- 2>&-"))
    end)

    it("fails only if it must write to standard output", function()
      assert.equal(0, (celspan("check " .. plain .. " >&- 2>&-")))
      assert.equal(5, (celspan("probe " .. plain .. " 1 1 >&-")))
    end)

    it("writes control characters in messages as numbers, and indents new lines", function()
      local script = bench:write("controls.lua", 'error("a\\27[31mred\\nnew\\u{9b}31m \\u{e4}", 0)')
      local _, _, message = celspan("check " .. script)
      assert.equal(("celspan: error: %s:1: a\\x1b[31mred\n    new\\x9b31m \u{e4}\n"):format(script),
        message)
      script = bench:write("controls.lua", 'error("a\\127\\8\\tb\\xc2", 0)')
      _, _, message = celspan("check " .. script)
      assert.equal(("celspan: error: %s:1: a\\x7f\\x08\tb\\xc2\n"):format(script), message)
    end)

    it("writes control characters that a script prints as numbers, to a terminal alone", function()
      if not present.program "script" then return pending "there is no script" end
      local path = bench:write("prints.lua",
        'print("a\\27]52;c;eA==\\7 \\u{9b}2J \\u{e4}\\tb\\r\\0") '
        .. 'return require "celspan".rostrum {}')
      local command = ("\"%s\" render %s --hash --progress none"):format(workbench.absolute, path)
      local _, _, plain_words = bench:shell(command)
      assert.equal("a\27]52;c;eA==\7 \u{9b}2J \u{e4}\tb\r\0\n", plain_words)
      local _, shown = bench:shell(("script -qec '%s' /dev/null </dev/null"):format(command))
      local wanted = "a\\x1b]52;c;eA==\\x07 \\x9b2J \u{e4}\tb\\x0d\\x00\r\n"
      assert.truthy(shown:find(wanted, 1, true), shown)
      assert.falsy(shown:find "\27")
    end)
  end)
end)
