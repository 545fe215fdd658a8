--- Makes tests/kit/krita/krita_keys.kra, a painting of Krita with keys of drawings and of an
-- opacity, and krita_keys.json, what Krita shows at points of each frame.
--
--   lua5.4 tests/material/krita_keys.lua [FOLDER]       default: tests/kit/krita
--
-- Needs krita, xvfb-run and Python's PyQt5 (Debian's krita, xvfb and python3-pyqt5).
-- tests/kit/spec/krita_spec.lua compares the files with celspan's pictures.
local root = arg[0]:match "^(.*)/tests/material/[^/]*$" or "."
local folder = arg[1] or root .. "/tests/kit/krita"

local function run(command, ...)
  local line = command:format(...)
  if not os.execute(line) then error("failed: " .. line) end
end

local function write(path, text)
  local file = assert(io.open(path, "w"))
  assert(file:write(text) and file:close())
end

local home = os.tmpname()
os.remove(home)
local plugins = home .. "/.local/share/krita/pykrita"
run("mkdir -p '%s/celspan_keys' '%s/.config' '%s/run' '%s' && chmod 700 '%s/run'", plugins, home,
  home, folder, home)
run("cp '%s/tests/material/krita_keys.py' '%s/celspan_keys/__init__.py'", root, plugins)
write(plugins .. "/celspan_keys.desktop", "[Desktop Entry]\nType=Service\n"
  .. "ServiceTypes=Krita/PythonPlugin\nX-KDE-Library=celspan_keys\nX-Python-2-Compatible=false\n"
  .. "Name=celspan keys\nComment=Makes a painting that moves\n")
write(home .. "/.config/kritarc", "[python]\nenable_celspan_keys=true\n")
run("HOME='%s' XDG_RUNTIME_DIR='%s/run' CELSPAN_KRITA='%s' timeout 300 xvfb-run -a krita "
  .. "--nosplash >'%s/log' 2>&1 || true", home, home, folder, home)
local made = io.open(folder .. "/krita_keys.kra")
if not made then run("cat '%s/log'; false", home) end
made:close()
run("rm -rf '%s' '%s/krita_keys.kra~'; ls -l '%s'", home, folder, folder)
