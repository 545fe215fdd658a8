-- packaging/install.sh, with an archive of a small substitute; and the program where a system lacks
-- what most have. The packages themselves are tried by `./run dist --test`.
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local PREFIX = "Öl und Käse/pre fix"

local bench

local function shell(format, ...) return bench:inside(format:format(...)) end

--- An archive of this version beside install.sh, with its sum. program: a shell script; ending: of
--- the archive's name.
local function pack(version, program, ending)
  local name = "celspan-" .. version .. "-linux-x86_64"
  bench:write("program", "#!/bin/sh\n" .. (program or "echo celspan " .. version) .. "\n")
  local code, _, err = shell([[mkdir -p %s/bin %s/share/man/man1 && cp program %s/bin/celspan &&
    chmod +x %s/bin/celspan && echo page >%s/share/man/man1/celspan.1 &&
    tar -caf %s.tar.%s %s && rm -r %s program && sha256sum celspan-*.tar.?z >SHA256SUMS]],
    name, name, name, name, name, name, ending or "gz", name, name)
  assert.equal(0, code, err)
  return name .. ".tar." .. (ending or "gz")
end

local function install(words)
  return shell("sh install.sh %s", words)
end

--- All that is in the folder for versions, hidden ones too.
local function versions() return table.concat(bench:files(PREFIX .. "/lib"), " ") end

before_each(function()
  bench = workbench.new()
  bench:write("install.sh", require("tests.support.system").read "packaging/install.sh")
end)

after_each(function() bench:remove() end)

describe("install.sh", function()
  it("installs into folders with spaces and umlauts, and names what it did", function()
    pack "0.1.0"
    local code, out, err = install(("--prefix '%s'"):format(PREFIX))
    assert.same({ 0, "" }, { code, err })
    assert.truthy(out:find("celspan 0.1.0 is in ", 1, true), out)
    assert.equal("celspan-0.1.0", versions())
    assert.same({ 0, "celspan 0.1.0\n", "" }, { shell("'%s/bin/celspan'", PREFIX) })
    assert.equal("page\n", bench:read(PREFIX .. "/share/man/man1/celspan.1"))
  end)

  it("keeps two versions side by side; the later one is celspan", function()
    pack "0.1.0"
    install(("--prefix '%s'"):format(PREFIX))
    local later = pack "0.2.0"
    local code, _, err = install(("--prefix '%s' %s"):format(PREFIX, later))
    assert.same({ 0, "" }, { code, err })
    assert.equal("celspan-0.1.0 celspan-0.2.0", versions())
    for name, version in pairs { celspan = "0.2.0", ["celspan-0.1.0"] = "0.1.0",
      ["celspan-0.2.0"] = "0.2.0" } do
      assert.same({ 0, "celspan " .. version .. "\n", "" },
        { shell("'%s/bin/%s'", PREFIX, name) })
    end
  end)

  it("takes the .tar.xz where it lies alone, and the .tar.gz where both do", function()
    local at = ("--prefix '%s'"):format(PREFIX)
    for _, ending in ipairs { "xz", "gz" } do
      pack("0.1.0", "echo " .. ending, ending)
      local code, _, err = install(at)
      assert.same({ 0, "" }, { code, err })
      assert.equal(ending .. "\n", select(2, shell("'%s/bin/celspan'", PREFIX)))
    end
    assert.equal("celspan-0.1.0", versions())
  end)

  it("says that what unpacks the archive is missing", function()
    pack("0.1.0", nil, "xz")
    shell "mkdir tools && ln -s $(which dirname basename uname tar sha256sum sh) tools"
    local code, out, err = shell("PATH=tools sh install.sh --prefix '%s'", PREFIX)
    assert.same({ 1, "", "install.sh: the program xz is missing\n" }, { code, out, err })
    assert.same({}, bench:files "Öl und Käse")
  end)

  it("replaces the same version", function()
    for _, said in ipairs { "one", "two" } do
      pack("0.1.0", "echo " .. said)
      assert.equal(0, (install(("--prefix '%s'"):format(PREFIX))))
      assert.equal(said .. "\n", select(2, shell("'%s/bin/celspan'", PREFIX)))
      assert.equal("celspan-0.1.0", versions())
    end
  end)

  --- Fails with one line that has the words, and leaves nothing behind.
  local function refused(words, arguments)
    local code, out, err = install(arguments)
    assert.same({ 1, "" }, { code, out })
    assert.truthy(err:find(words, 1, true), err)
    assert.equal("", versions())
  end

  it("refuses an archive that is not what SHA256SUMS says", function()
    local archive = pack "0.1.0"
    local at = ("--prefix '%s'"):format(PREFIX)
    shell("echo more >>%s", archive)
    refused("its sum is not the one in SHA256SUMS", at)
    bench:write("SHA256SUMS", "0  another.tar.gz\n")
    refused("has no sum of " .. archive, at)
    shell "rm SHA256SUMS"
    refused("SHA256SUMS is missing beside", at)
    refused("there is no archive none.tar.gz", at .. " none.tar.gz")
    assert.same({}, bench:files "Öl und Käse")
  end)

  it("leaves nothing of an archive that is cut off, or whose program does not run", function()
    local at = ("--prefix '%s'"):format(PREFIX)
    shell("head -c 200 %s >cut && mv cut celspan-0.1.0-linux-x86_64.tar.gz && "
      .. "sha256sum celspan-*.tar.gz >SHA256SUMS", pack "0.1.0")
    refused("the archive could not be unpacked", at)
    pack("0.1.0", "echo no glibc 2.99 >&2; exit 1")
    refused("celspan does not run here: no glibc 2.99", at)
  end)

  it("leaves nothing half-installed when it is stopped, and cleans up after a kill", function()
    -- The program of the archive writes its number into a pipe and stays.
    shell "mkfifo begun"
    pack("0.1.0", ("echo $$ >'%s/begun'; exec sleep 1000"):format(bench.folder))
    for _, case in ipairs { { "TERM", false }, { "KILL", true } } do
      local signal, left = table.unpack(case)
      local code, _, err = shell([[true; sh install.sh --prefix '%s' & process=$!
        read -r number <begun; kill -%s $process; kill $number; wait $process]], PREFIX, signal)
      assert.is_true(code ~= 0, err)
      assert.equal(left, versions():find "^%.celspan%-0%.1%.0%.%d+$" ~= nil, versions())
      assert.equal("", table.concat(bench:files(PREFIX .. "/bin"), " "))
    end
    pack "0.1.0"
    assert.equal(0, (install(("--prefix '%s'"):format(PREFIX))))
    assert.equal("celspan-0.1.0", versions())
  end)

  it("says that a folder cannot be written", function()
    pack "0.1.0"
    refused("cannot be written: give another --prefix DIR", "--prefix /proc/self/none")
    bench:write("file", "")
    refused("cannot be written: give another --prefix DIR", "--prefix file")
  end)

  it("explains itself, and refuses other words", function()
    local code, out = install "--help"
    assert.equal(0, code)
    assert.truthy(out:find("install.sh [--prefix DIR] [ARCHIVE]", 1, true), out)
    refused("unknown option '--verbose'", "--verbose")
    refused("--prefix: name a folder", "--prefix")
  end)
end)

--- Whether this process may have mounts of its own.
local may_mount = os.execute "unshare --mount true 2>/dev/null" == true
local it_mounts = may_mount and it or pending

describe("celspan", function()
  it_mounts("reads pictures and starts processes where /proc is not mounted", function()
    if not present.pictures() then return pending "celspan was built without OpenImageIO" end
    local function without_proc(arguments)
      return bench:shell(("unshare --mount sh -c 'umount -l /proc && exec \"%s\" %s'")
        :format(workbench.absolute, arguments))
    end
    local code, out, err = without_proc "info scripts/pictures/canal.png"
    assert.same({ 0, "" }, { code, err })
    assert.same(out, (select(2, bench:celspan "info scripts/pictures/canal.png")))
    local rendered, _, why = without_proc(("render scripts/picture.lua --frames 1 "
      .. "-o %s/a.png --progress none"):format(bench.folder))
    assert.same({ 0, "" }, { rendered, why })
  end)

  it_mounts("needs neither a home nor a /tmp in which programs run", function()
    bench:write("plain.lua", require "tests.support.plain_film")
    local code, _, err = bench:shell(([[unshare --mount sh -c '
      mount -t tmpfs -o ro,noexec none /mnt && cd "%s" &&
      HOME=/mnt TMPDIR=/mnt exec "%s" render plain.lua --frames 1 -o a.png --progress none']])
      :format(bench.folder, workbench.absolute))
    assert.same({ 0, "" }, { code, err })
  end)
end)
