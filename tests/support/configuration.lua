--- The text of a configuration of colours with two spaces: `light`, and `half`, whose conversions
--- are the lines `conversions`. searched: the line that says where files are searched.
local TEXT = [[ocio_profile_version: 2
%s
roles:
  default: light
  scene_linear: light
displays:
  screen:
    - !<View> {name: half, colorspace: half}
colorspaces:
  - !<ColorSpace>
    name: light
    aliases: [lin_rec709]
  - !<ColorSpace>
    name: half
%s
]]

return function(searched, conversions) return TEXT:format(searched, conversions) end
