-- The documentation: its examples run, its commands exist, its names are those of the code. One
-- file, because all pages are read in the same way.
--
--   ```lua   a complete script or program; its first lines may say
--              -- name.lua          its file name, else example.lua
--              -- error: TEXT       it must fail, and TEXT must be in the message
--              --> TEXT             (anywhere) a line that it prints
--            a file named *_spec.lua is a spec, and passes; `-- name.lua: a module` is one
--            that another example requires
--   ```text  a file that is saved under the name in backquotes before the colon above it
--   ```sh    commands: those that begin with `celspan` are run, in a folder with the examples
--            and, after `cd FOLDER`, in that folder
--   ```c     a part of one of the programs in examples/
local celspan = require "celspan"
local lotties = require "tests.support.lotties"
local markdown = require "tests.support.markdown"
local own = require "tests.support.own"
local pictures = require "docs.pictures.list"
local present = require "tests.support.present"
local raised = require "tests.support.raised"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local BINARY = workbench.absolute

local function first_line(text) return text:match "[^\n]*" end

local root = first_line(system.output "pwd")
local interpreter = first_line(system.output "readlink /proc/$PPID/exe")

local pages = { "README.md" }
for path in system.output("ls docs/*.md"):gmatch "[^\n]+" do pages[#pages + 1] = path end

local folder

--- Makes card.lottie of the examples, as the command in docs/lottie.md does with zip, which is not
--- installed everywhere.
local function pack_card()
  local members = {}
  for i, name in ipairs { "manifest.json", "a/card.json", "t/day.json", "t/night.json" } do
    members[i] = { name, markdown.read(folder .. "/" .. name:match "[^/]*$") }
  end
  system.write(folder .. "/card.lottie", lotties.archive(members))
end

setup(function()
  folder = os.tmpname()
  os.remove(folder)
  assert(os.execute(("mkdir -p %s/bin %s/scripts && ln -s '%s' %s/bin/celspan")
    :format(folder, folder, BINARY, folder)))
  assert(os.execute(("cd scripts && cp -r works type stage town %s/scripts/"):format(folder)))
  assert(os.execute(("cd scripts && cp -r pictures drawings stage town type paintings pencil "
    .. "pencil.lua demo/line.tsv %s/")
    :format(folder)))
  for _, page in ipairs(pages) do
    markdown.save(page, folder, function(block)
      return block.language == "lua" and block.name or block.language == "text"
    end)
  end
  pack_card()
  assert(os.execute(("cd %s && '%s' sounds.lua"):format(folder, interpreter)))
end)

teardown(function() os.execute("rm -r " .. folder) end)

--- Runs a command in the folder of the examples: exit code, standard output, standard error.
local function run(command, where)
  local _, how, code =
    os.execute(("cd %s && PATH=$PWD/bin:$PATH && { cd ./%s && %s ; } >out.txt 2>err.txt")
    :format(folder, where or "", command))
  return how == "signal" and 128 + code or code, markdown.read(folder .. "/out.txt"),
    markdown.read(folder .. "/err.txt")
end

--- A path as part of a test's name.
local function place(page, block) return ("%s:%d %s"):format(page, block.line, block.name or "") end

local function write_example(block)
  local error_text = block.text:match "^%-%- error: ([^\n]*)"
  local name = block.name or (error_text and error_text:match "^(%w+)%.lua:") or "example"
  local path = name .. ".lua"
  local file = assert(io.open(folder .. "/" .. path, "wb"))
  file:write(block.text)
  file:close()
  return path, error_text
end

--- If celspan was built without the module that an example needs, or there is no ffmpeg, it is
--- skipped.
local function check_module(message)
  local module = message:match "celspan%-%l+%.so, which was not found"
    or message:match "ffmpeg, which reads sounds, is not in PATH"
  if module then pending(module) end
end

local function check_code(code, message, printed)
  check_module(message)
  assert.are.equal(0, code, (printed or "") .. message)
end

local HAS_ALL = (tonumber(os.getenv "CELSPAN_SCENES") or 300) >= 300
local SEED = tonumber(os.getenv "CELSPAN_SEED") or 1

--- The option with the frames that stand for all of a film, except in --all: one in eight.
local function sample_of(text)
  local fields = text:match "film (%b{})%s*$" or ""
  local rate, seconds = fields:match "fps = (%d+)", fields:match "duration = ([%d.]+)"
  local count = tonumber(fields:match "frames = (%d+)" or seconds and seconds * (rate or 24))
  return not HAS_ALL and count and count > 8 and ("--frames 1-%d:8"):format(count) or ""
end

local function render_small(path, block)
  return run(("celspan render %s -o pictures_made/%s.####.png --scale 0.1 --progress none %s %s")
    :format(path, path, block.options or "", sample_of(block.text)))
end

--- The lines that a program prints according to its comments -->.
local function promised(text)
  local lines = {}
  for line in text:gmatch "%-%-> ([^\n]*)" do lines[#lines + 1] = line .. "\n" end
  return table.concat(lines)
end

describe("the examples of", function()
  for _, page in ipairs(pages) do
    for _, block in ipairs(markdown.blocks(page)) do
      local returns = block.text:find "^return " or block.text:find "\nreturn "
      local is_module = block.text:find "^%-%- [%w_]+%.lua: a module"
      if block.language == "lua" and is_module then
        it(place(page, block) .. " load", function()
          write_example(block)
          system.write(folder .. "/uses.lua",
            ("local module = require %q\nreturn rostrum { module and nil }\n"):format(block.name))
          local code, _, message = run "celspan info uses.lua"
          assert.are.equal(0, code, message)
        end)
      elseif block.language == "lua" and returns then
        it(place(page, block) .. " render", function()
          local path, error_text = write_example(block)
          local code, _, message = render_small(path, block)
          if error_text then
            check_module(message)
            assert.is_true(code == 3 or code == 4, message)
            assert.is_truthy(message:find(error_text, 1, true), message)
          else
            check_code(code, message)
          end
        end)
      elseif block.language == "lua" and (block.name or ""):find "_spec$" then
        it(place(page, block) .. " pass", function()
          local code, printed, message = run("celspan test " .. write_example(block))
          check_code(code, message, printed)
        end)
      elseif block.language == "lua" then
        it(place(page, block) .. " run", function()
          local path = write_example(block)
          local code, printed, message = run(("LUA_PATH=';;' LUA_CPATH='%s' '%s' %s")
            :format(package.cpath, interpreter, path))
          check_code(code, message)
          assert.are.equal(promised(block.text), printed)
        end)
      end
    end
  end
end)

--- Whether a command makes a video.
local function needs_ffmpeg(line)
  for _, word in ipairs { "ffmpeg", "%.mp4", "%.mov", "%.webm", "%.mkv", "%.gif", "%.webp",
    "%.apng" } do
    if line:find(word) then return true end
  end
  return false
end

describe("the commands of", function()
  local has_ffmpeg = present.program "ffmpeg"
  local run_help = system.output "./run help"
  for _, page in ipairs(pages) do
    for _, block in ipairs(markdown.blocks(page)) do
      local where
      for line in (block.language == "sh" and block.text or ""):gmatch "[^\n]+" do
        where = line:match "^cd ([%w_]+)$" or where
        local here, laid = where, line:match "^celspan init ([%w_]+)$"
        if line:find "^celspan watch " or line:find "^celspan play " then
          it(place(page, block) .. line .. " run until they are ended", function()
            if not present.web() then return pending "celspan was built without libmicrohttpd" end
            local code, printed, message = run("export BROWSER=true; timeout 1 " .. line, here)
            assert.are.equal(124, code, message)
            local line_printed = "^watching http://127%.0%.0%.1:%d+/%?token=%x+\n$"
            assert.is_truthy(printed:find(line_printed), message)
          end)
        elseif line:find "^celspan " and (has_ffmpeg or not needs_ffmpeg(line)) then
          it(place(page, block) .. line .. " run", function()
            if line:find("--ocio", 1, true) and not present.spaces() then
              return pending "celspan was built without OpenColorIO"
            end
            local command = line
            if laid then command = ("rm -rf %s; %s"):format(laid, line) end
            local has_size = line:find "%-%-size" or line:find "%-%-scale" or line:find "%-%-table"
            if needs_ffmpeg(line) and line:find "^celspan render" and not has_size then
              command = command .. " --scale 0.25"
            end
            -- A leak check attaches to the process from another one, which --strict does not allow.
            local is_strict = line:find("--strict", 1, true)
            if is_strict then command = "ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 " .. command end
            local code, _, message = run(command, here)
            if is_strict and code == 6 and message:find("--strict: ", 1, true) then
              return pending "the kernel cannot confine a process"
            end
            check_code(code, message)
          end)
        elseif line:find "^oiiotool " then
          it(place(page, block) .. line .. " run #plain", function()
            if not (present.pictures() and present.program "oiiotool") then
              return pending "there is no oiiotool, or celspan was built without OpenImageIO"
            end
            local plugins = workbench.build .. "/src/kit/plugins/oiio/plugin"
            local code, printed, message = run(("OIIO_LIBRARY_PATH='%s' %s"):format(plugins, line))
            assert.are.equal(0, code, printed .. message)
          end)
        elseif line:find "^%./run " then
          it(place(page, block) .. line .. " exist", function()
            local verb, option = line:match "^%./run (%l+)%s*(%-*%l*)"
            assert.is_truthy(run_help:find("\n  " .. verb .. " ", 1, true), verb)
            assert.is_truthy(option == "" or run_help:find(option, 1, true), option)
          end)
        end
      end
    end
  end
end)

describe("the command line's page", function()
  local text = markdown.read "docs/command-line.md"

  it("names every verb and option of the program, and no other", function()
    local known = {}
    for verb in system.output("'" .. BINARY .. "' help"):gmatch "\n  (%l+) +[A-Z%[]" do
      assert.is_truthy(text:find("\n## " .. verb .. "\n", 1, true) or verb == "help", verb)
      for option in system.output("'" .. BINARY .. "' help " .. verb):gmatch "\n  (%-[%w-]+)" do
        known[option] = true
        local named = "`" .. option:gsub("%-", "%%-") .. "[` ]"
        assert.is_truthy(text:find(named), verb .. " " .. option)
      end
    end
    for option in text:gmatch "`(%-%-[%w-]+)" do
      assert.is_truthy(known[option] or option == "--version" or option == "--help", option)
    end
  end)
end)

--- The pages of the Lua reference, one after the other.
local reference = ""
for _, page in ipairs(pages) do
  if page:find "^docs/lua" then reference = reference .. markdown.read(page) end
end

--- The section of the Lua reference that begins with a heading.

local function section(heading)
  local from = reference:find("\n### " .. heading, 1, true)
  assert.is_truthy(from, "the Lua reference has no section " .. heading)
  local to = reference:find("\n##", from + 4, true)
  return reference:sub(from, to or -1)
end

local annotations = own "celspan.manual".annotations()

--- The named fields of an annotated class.
local function annotated(class)
  local _, at = annotations:find("@class celspan%." .. class:gsub("%.", "%%.") .. "[:\n][^@]*")
  assert(at, class)
  local names = {}
  for line in annotations:sub(at + 1):gmatch "@([^\n]*)" do
    if not line:find "^field " then break end
    names[#names + 1] = line:match "^field (%l[%w_]*)"
  end
  return names
end

--- The fields that a constructor lists when it is given an unknown one.
local function fields_of(make)
  local message = raised.message(make, { ["@@@@@@@@@@"] = true })
  local names = {}
  for name in (tostring(message):match "the fields are (.*)" or ""):gmatch "[%w_]+" do
    names[#names + 1] = name
  end
  return names
end

describe("the Lua reference", function()
  it("has a section for every name of the module, and no other", function()
    for name in pairs(celspan) do section("celspan." .. name) end
    for name in reference:gmatch "\n### celspan%.([%w_]+)" do
      assert.is_not_nil(celspan[name], name)
    end
  end)

  it("names every field of every constructor, as the annotations do", function()
    for _, name in ipairs { "paint", "linear", "radial", "picture", "rect", "triangle", "circle",
                            "ellipse", "polygon", "nurbs", "path", "image", "scanline", "cel",
                            "rostrum", "film" } do
      local fields = fields_of(celspan[name])
      assert.is_true(#fields > 0, name)
      local text = section("celspan." .. name)
      for _, field in ipairs(fields) do
        assert.is_truthy(text:find("`" .. field .. "`", 1, true), name .. "." .. field)
        assert.is_truthy(annotations:find("---@field " .. field .. "[? ]"), name .. "." .. field)
      end
    end
  end)

  it("and the annotations name no field that is not there", function()
    for name in annotations:gmatch "@class celspan%.(%l+)%.fields" do
      local known, make = {}, rawget(celspan, name)
      for _, field in ipairs(make and fields_of(make) or {}) do known[field] = true end
      for _, field in ipairs(make and annotated(name .. ".fields") or {}) do
        assert.is_truthy(known[field], name .. " " .. field)
      end
    end
  end)

  it("names every option of rendering", function()
    local nothing = celspan.rostrum {}
    for name, call in pairs {
      render = function(o) celspan.render(nothing, "x.png", o) end,
      pixels = function(o) celspan.pixels(nothing, o) end,
      spans = function(o) celspan.spans(nothing, o) end,
    } do
      local text = section("celspan." .. name) .. section "Options"
      for _, field in ipairs(fields_of(call)) do
        assert.is_truthy(text:find("`" .. field .. "`", 1, true), name .. " " .. field)
        assert.is_truthy(annotations:find("---@field " .. field .. "[? ]"), name .. " " .. field)
      end
    end
  end)

  it("names the methods of objects and cels, and no other", function()
    local circle = celspan.circle { centre = { 0, 0 }, radius = 1 }
    local text = section "Methods"
    for name in annotations:gmatch "\nfunction placed:(%w+)%(" do
      assert.is_truthy(text:find("`value:" .. name .. "(", 1, true)
        or text:find("`value:" .. name .. "{", 1, true), name)
    end
    for name in text:gmatch "`value:(%w+)[({]" do
      assert.are.equal("function", type(circle[name]), name)
    end
  end)

  it("names the fields of a frame", function()
    celspan.film { frame = function(f)
      local text = section "The frame"
      for name in text:gmatch "\n| `f%.(%w+)`" do
        assert.are.equal(name == "size" and "table" or "number", type(f[name]), name)
      end
      for _, name in ipairs(annotated "frame") do
        assert.is_truthy(text:find("`f." .. name .. "`", 1, true), name)
      end
      return celspan.rostrum {}
    end }:at(1)
  end)

  it("names the modules of the library and their contents", function()
    for _, name in ipairs { "ease", "keys", "motion", "multiplane", "shutter", "lips", "sheet",
      "svg", "layers",
                            "oca", "json", "cut", "sound", "spec" } do
      local text = section("Module celspan." .. name)
      local module = require("celspan." .. name)
      for key, value in pairs(module) do
        if type(value) == "function" then
          local call = ("%s%%.%s ?[({]"):format(name, key)
          assert.is_truthy(text:find(call), name .. "." .. key)
        end
      end
    end
  end)
end)

describe("the C reference", function()
  local text = markdown.read "docs/c.md"
  -- Without the functions behind the macros of initial values, such as CELSPAN_CODING.
  local header = system.output("cat src/*/include/celspan/*.h"):gsub("%f[%w_]%g+_initial%(", "(")
  header = header .. header:gsub("CELSPAN_DESCRIPTION%(([%l_]+)%)", "%1_default(")

  it("names every function of the header, and no other", function()
    for name in header:gmatch "%f[%w_](celspan_%l[%w_]*)%(" do
      assert.is_truthy(text:find("%f[%w_]" .. name .. "%f[^%w_]"), name)
    end
    for name in text:gmatch "%f[%w_](celspan_%l[%w_]*)" do
      assert.is_truthy(header:find("%f[%w_]" .. name .. "%f[^%w_]"), name)
    end
    for name in text:gmatch "%f[%w_](CELSPAN_%u[%u%d_]*)" do
      assert.is_truthy(header:find("%f[%w_]" .. name .. "%f[^%w_]"), name)
    end
  end)

  it("shows code of the example programs", function()
    local programs = system.output "cat examples/*.c"
    for _, block in ipairs(markdown.blocks "docs/c.md") do
      if block.language == "c" then
        assert.is_truthy(programs:find(block.text, 1, true), "docs/c.md:" .. block.line)
      end
    end
  end)
end)

describe("every page", function()
  --- The anchor of a heading, as forges make it.
  local function anchors_of(page)
    local anchors = {}
    for heading in markdown.prose(page):gmatch "\n#+ ([^\n]+)" do
      anchors[heading:lower():gsub("[^%w%s_-]", ""):gsub(" ", "-")] = true
    end
    return anchors
  end

  for _, page in ipairs(pages) do
    it(page .. " links only to existing pages, sections and files", function()
      local here = page:match "^(.*/)" or ""
      for target in markdown.prose(page):gmatch "%]%(([^)]+)%)" do
        local path, anchor = target:match "^([^#]*)#?(.*)$"
        if not target:find "^https?:" then
          local file = path == "" and page or here .. path
          assert.is_true(system.exists(file), target)
          assert.is_true(anchor == "" or anchors_of(file)[anchor] or false, target)
        end
      end
    end)
  end

  --- Whether a path is a file of the tree, or of one of its houses.
  local function is_there(path)
    for _, house in ipairs { "", "src/core/", "src/kit/", "src/desk/" } do
      if system.exists(house .. path) then return true end
    end
    return path:find "^out/" ~= nil
  end

  it("names only existing files of the tree", function()
    for _, page in ipairs(pages) do
      for path in markdown.prose(page):gmatch "`(%l+/[%w_./-]+%.%l+)`" do
        assert.is_true(not path:find "^%l+/[%w_/-]*%.[%w]+$" or is_there(path),
          page .. ": " .. path)
      end
    end
  end)
end)

describe("the guide", function()
  it("lists its chapters in both parts", function()
    for _, page in ipairs { "docs/guide.md", "docs/guide-picture.md", "docs/first-hour.md" } do
      local listed, chapters = {}, {}
      local text = markdown.read(page)
      for name in text:gmatch "\n%d+%. %[([^%]]+)%]" do listed[#listed + 1] = name end
      for name in text:gmatch "\n## ([^\n]+)" do chapters[#chapters + 1] = name end
      if chapters[#chapters] == "What now" then table.remove(chapters) end
      assert.are.same(chapters, listed)
    end
  end)
end)

describe("the cookbook", function()
  local LINES, COLUMNS = 36, 90
  local page = "docs/cookbook.md"
  local text = markdown.read(page)

  --- Films are recipes; a program makes the files of the one after it.
  local function is_recipe(block)
    return block.language == "lua" and block.text:find "\nreturn " ~= nil
  end

  it("has blocks of few lines, and a picture of each recipe", function()
    local count = 0
    for _, block in ipairs(markdown.blocks(page)) do
      local _, lines = block.text:gsub("\n", "")
      assert.is_true(lines <= LINES, ("line %d: %d lines"):format(block.line, lines))
      for line in block.text:gmatch "[^\n]+" do
        assert.is_true(utf8.len(line) <= COLUMNS, line)
      end
      if is_recipe(block) then
        count = count + 1
        assert.is_truthy(text:find("](pictures/" .. block.name .. ".", 1, true), block.name)
      end
    end
    local _, titles = text:gsub("\n### ", "")
    assert.are.equal(count, titles)
    assert.is_truthy(text:find("\n" .. count .. " tasks", 1, true), count .. " tasks")
  end)

  it("is found by its words", function()
    local recipes = loadfile "src/desk/program/verbs/recipes.lua"(text)
    local find = loadfile "src/desk/program/verbs/search.lua"(function() end, {})
    for title, words in text:gmatch "\n### ([^\n]+)\n\n%*Words: (.-)%*" do
      for word in words:gsub("\n", " "):gmatch "%s*([^,]+)" do
        local titles = {}
        for _, recipe in ipairs(find(recipes, word, 3)) do titles[recipe.title] = true end
        assert.is_true(titles[title] or false, word)
      end
    end
  end)

  it("is printed, as one recipe or as the list of those that fit", function()
    local code, printed = run "celspan help 'Drop Shadow'"
    assert.are.equal(0, code)
    assert.are.equal(printed, select(2, run "celspan help drop-shadow"))
    assert.is_truthy(printed:find("\n-- drop_shadow.lua", 1, true), printed)
    assert.is_falsy(printed:find("```", 1, true) or printed:find("](", 1, true), printed)
    code, printed = run "celspan help cookbook"
    local _, lines = printed:gsub("\n  %u", "")
    local _, titles = text:gsub("\n### ", "")
    assert.are.same({ 0, titles }, { code, lines })
    code, printed = run "celspan help shadwo"
    assert.are.equal(0, code)
    assert.is_truthy(printed:find("\n    celspan help cast_shadow\n", 1, true), printed)
  end)
end)

describe("the tables of outputs", function()
  it("that the program prints have every format of the page", function()
    local code, printed = run "celspan help formats"
    assert.are.equal(0, code)
    local rows = markdown.read "docs/formats.md":match "\n| extension .-\n(|.-)\n\n"
    local seen = 0
    for name in rows:gmatch "| (%l%w*)[^\n]*" do
      seen = seen + 1
      assert.is_truthy(printed:find("%f[%w]" .. name .. "%f[%W]"), name)
    end
    assert.is_true(seen > 15)
  end)
end)

describe("the pictures", function()
  local PYTHON = "/usr/bin/python3"
  local has_decoders = present.program "ffmpeg" and present.program(PYTHON) and os.execute(PYTHON
    .. " -c 'from PIL import features; exit(not features.check(\"webp_anim\"))' 2>/dev/null")
  local file_of = pictures.file_of

  --- Whether an animated WebP is repeated endlessly.
  local function is_loop(webp)
    local control = webp:find("ANIM\6\0\0\0", 1, true)
    return webp:find "^RIFF....WEBPVP8X" and string.unpack("<I2", webp, control + 12) == 0
  end

  it("are all shown in a page, and small", function()
    local text = ""
    for _, page in ipairs(pages) do text = text .. markdown.prose(page) end
    for _, picture in ipairs(pictures) do
      local content = markdown.read("docs/pictures/" .. file_of(picture))
      assert.is_truthy(text:find("pictures/" .. file_of(picture), 1, true), picture.name)
      assert.is_true(not picture.loop or is_loop(content), picture.name)
      assert.is_true(#content < (picture.most or picture.loop and 150000 or 300000), picture.name)
    end
    local all = system.output("cd docs/pictures && cat *.png *.mp4 *.webp works/*")
    assert.is_true(#all < 12000000, #all)
  end)

  it("are all in the gallery, which lists every film of scripts/", function()
    local printed = system.output "lua5.4 docs/pictures/gallery.lua"
    assert.are.equal(printed, markdown.read "docs/gallery.md")
    local _, count = printed:gsub("%]%(%.%./scripts/[%w_/]+%.lua%)", "")
    local files = system.output "ls scripts/*.lua scripts/works/*.lua | wc -l"
    assert.are.equal(tonumber(files), count)
  end)

  it("begin, on the front page, with a film and its sound", function()
    local page = markdown.prose "README.md"
    local shown = page:match "!%b[]%((.-)%)"
    assert.are.equal("docs/pictures/moving.webp", shown)
    assert.is_truthy(page:find("(docs/pictures/little-one.mp4)", 1, true))
  end)

  --- Fails if the frames of two films differ by more than `most` codes in any square: losses do by
  --- less, a ghost by 40, and another frame, too.
  local function check_frames(kept, made, fps, most)
    local printed, is_done = system.output(("%s docs/pictures/off.py '%s' '%s' %s 2>&1")
      :format(PYTHON, kept, made, fps))
    assert.is_true(is_done, kept .. ": " .. printed)
    assert.is_true(tonumber(printed:match "^%d+") <= most, kept .. ": " .. printed)
  end

  -- One in four, except with --all.
  it("are what their scripts make (./run docs makes them again) #full", function()
    if not has_decoders then return pending "no program decodes WebP and movies" end
    local made, chosen, names = folder .. "/made", {}, ""
    for i = HAS_ALL and 1 or 1 + SEED % 4, #pictures, HAS_ALL and 1 or 4 do
      chosen[#chosen + 1], names = pictures[i], names .. " " .. pictures[i].name
    end
    local code, _, message = run(("cd '%s' && lua5.4 docs/pictures/make.lua '%s' %s --exact %s")
      :format(root, BINARY, made, names))
    check_code(code, message)
    for _, picture in ipairs(chosen) do
      local file = picture.loop and picture.name .. ".mkv" or file_of(picture)
      local now = made .. "/" .. file
      local kept = root .. "/docs/pictures/" .. file_of(picture)
      if picture.loop then
        check_frames(kept, now, picture.fps or 12, picture.off or 14)
      elseif markdown.read(now) ~= markdown.read(kept) then
        local status, printed = run(("celspan compare %s '%s' --fail 0.02"):format(now, kept))
        assert.are.equal(0, status, picture.name .. ": " .. printed)
      end
    end
  end)

  it("and the film with its sound is what scripts/film.lua makes #full", function()
    if not has_decoders then return pending "no program decodes movies" end
    local code, _, message = run(("mkdir film && celspan render '%s/scripts/film.lua' %s "
      .. "--size 960x540 --no-dither --progress none -o film/%%04d.png")
      :format(root, HAS_ALL and "" or "--frames 1-708:101"))
    check_code(code, message)
    check_frames("docs/pictures/little-one.mp4", folder .. "/film/%04d.png", 24, 20)
  end)
end)
