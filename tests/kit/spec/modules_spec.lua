-- Messages about a module that cannot be used: which it is, what is wrong with it, and what to do.
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local ADVICE = "or name %s file in CELSPAN_%s_MODULE\n"

local bench

before_each(function()
  bench = workbench.new()
  bench:write("profile.kra",
    paintings.krita { w = 4, h = 4, profile = paintings.profile {}, layers = {} })
end)
after_each(function() bench:remove() end)

local opened = { PICTURE = "scripts/pictures/canal.png", TYPE = "scripts/paintings/valley.ora" }

--- Opens a picture, a painting that is an archive, or one with a colour profile, with the module in
--- a file; returns the message.
local function said_of(kind, file, before)
  local code, out, err = bench:shell(("%s CELSPAN_%s_MODULE='%s' '%s' info %s --trust"):format(
    before or "", kind, file, workbench.absolute, opened[kind] or bench.folder .. "/profile.kra"))
  assert.are.equal(4, code, err)
  assert.are.equal("", out)
  return err
end

local function assert_said(kind, file, parts, before)
  local words, at = said_of(kind, file, before), 1
  for _, part in ipairs(parts) do
    local _, last = words:find(part, at, true)
    assert.is_truthy(last, ("%s is not in order in: %s"):format(part, words))
    at = last + 1
  end
  assert.are.equal(#words + 1, at, words)
end

local colour = present.colour() and present.type() and "COLOUR" or nil
for _, kind in ipairs { "PICTURE", "TYPE", colour } do
  local name = ("celspan-%s.so"):format(kind:lower())
  local needed = ("needs the module %s, "):format(name)
  local advised = kind == "PICTURE" and "OpenImageIO" or "celspan"

  describe("the module " .. name, function()
    it("must be installed or named when it is missing", function()
      local path = bench.folder .. "/none.so"
      assert_said(kind, path, { needed, "was not found at " .. path .. ": ", advised,
        ADVICE:format("the", kind) })
    end)

    it("must be made readable, or another named, when it cannot be read", function()
      local path = bench.folder .. "/turning.so"
      bench:shell(("ln -s '%s' '%s'"):format(path, path))
      assert_said(kind, path, { needed, "but " .. path .. " cannot be read: ",
        "Too many levels of symbolic links; make it readable, ", ADVICE:format("another", kind) })
    end)

    it("must be installed, or another named, when it cannot be loaded", function()
      local path = bench:write("text.so", "no module")
      assert_said(kind, path, { needed, "which cannot be loaded: ", path, ": ", advised,
        ADVICE:format("another", kind) })
    end)

    it("must be installed, or another named, when it is another file", function()
      local other = kind == "TYPE" and "/tests/hostile_module.so"
        or "/src/kit/plugins/type/celspan-type.so"
      local path = workbench.build .. other
      local file = io.open(path)
      if not file then return pending(path .. " is not built") end
      file:close()
      assert_said(kind, path, { path .. " is not a module of this celspan (it lacks celspan_"
        .. kind:lower() .. "_module): ", advised, ADVICE:format("another", kind) })
    end)
  end)
end

describe("a picture module of another version", function()
  it("must be replaced", function()
    local path = workbench.build .. "/tests/hostile_module.so"
    assert_said("PICTURE", path, { path .. " is of another version of celspan (", ", not ", "): ",
      "OpenImageIO", ADVICE:format("another", "PICTURE") }, "HOSTILE_IS_OLD=1")
  end)
end)

describe("the list of libraries beside a module", function()
  local built = workbench.build .. "/src/kit/plugins/oiio/celspan-picture.so"

  --- Reads a picture with the module, which is given this list.
  local function read(list, before, mode)
    bench:shell(("ln -sf '%s' '%s/own.so'"):format(built, bench.folder))
    bench:write("own.so.list", list)
    local command = ("%s CELSPAN_PICTURE_MODULE='%s/own.so' '%s' info %s %s"):format(before,
      bench.folder, workbench.absolute, opened.PICTURE, mode)
    local code, out, err = bench:shell(command)
    assert.equal(0, code, err)
    return out, err
  end

  it("is opened before it, and may name what is missing", function()
    if not present.program(built) then return pending "celspan-picture.so was not built" end
    local list = "libcelspan-none.so.7\n\n" .. ("x"):rep(9000) .. "\nlibc.so.6"
    assert.equal(read("", "", ""), (read(list, "", "")))
    local _, trace = read(list, "LD_DEBUG=files", "--trust")
    local first = trace:find("file=libcelspan-none.so.7 [0];  dynamically loaded", 1, true)
    assert.is_truthy(first and trace:find("file=libOpenImageIO.", first, true), "not opened first")
    assert.is_falsy(trace:sub(1, first):find("file=libOpenImageIO.", 1, true))
  end)

  it("has each library of OpenImageIO after those that it needs", function()
    local file = io.open(built .. ".list")
    local list = file and file:read "a" or ""
    if file then file:close() end
    if list == "" then return pending "OpenImageIO lies in its own folder, or ldd is missing" end
    local image = list:find("libOpenImageIO.so", 1, true)
    assert.is_truthy(image and list:find("libOpenImageIO_Util.so", 1, true) < image, list)
  end)
end)
