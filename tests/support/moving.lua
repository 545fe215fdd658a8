--- Drawings that move, for tests against a browser: each is 100 by 100 px, as the contents of its
--- svg element.
---
---   moving.smil      animate, set, animateTransform and animateMotion, with all their attributes
---   moving.styles    @keyframes
---   moving.paths     the same, with lists of stops and paths of the style
---   moving.times     the seconds at which all are compared
---   moving.document(scene)      the whole file
local moving = {}

local BOX = '<rect x="20" y="30" width="30" height="24" fill="#2a6f97">%s</rect>'
local DOT = '<circle cx="50" cy="50" r="12" fill="#c1121f">%s</circle>'
local ARROW = '<path d="M-10 -6L10 0L-10 6Z" fill="#386641">%s</path>'

local function box(text) return { BOX:format(text) } end
local function dot(text) return { DOT:format(text) } end
local function arrow(text) return { ARROW:format(text) } end

--- A box that is animated in x.
local function slide(text) return box('<animate attributeName="x" ' .. text .. "/>") end

local function turn(text)
  return box('<animateTransform attributeName="transform" ' .. text .. "/>")
end

--- Three boxes, one above the other, each animated in x.
local function lanes(...)
  local parts = {}
  for i, text in ipairs { ... } do
    local colour = ({ "#bc4749", "#386641", "#2a6f97" })[i]
    parts[i] = ('<rect width="20" height="20" y="%d" fill="%s"><animate attributeName="x" '
      .. 'from="20" to="80" %s/></rect>'):format(30 * i - 20, colour, text)
  end
  return { table.concat(parts) }
end

local function fly(text) return arrow("<animateMotion " .. text .. "</animateMotion>") end

moving.smil = {
  slide 'from="0" to="70" dur="2s"',
  slide 'from="10" to="60" dur="1.5s" fill="freeze"',
  slide 'from="5" by="40" dur="1s" repeatCount="2.5" fill="freeze"',
  slide 'by="30" dur="2s" begin="0.5s"',
  slide 'to="65" dur="2s" fill="freeze"',
  slide 'values="0;60;20;50" dur="2s" repeatCount="indefinite"',
  slide 'values="0;60;20" keyTimes="0;0.2;1" dur="2s"',
  slide 'values="0;60;20" keyTimes="0;0.4;1" calcMode="discrete" dur="2s"',
  slide 'values="0;60;40;70" calcMode="discrete" dur="2.4s" fill="freeze"',
  slide 'values="0;10;70" calcMode="paced" dur="2s"',
  slide('values="0;70;0" keyTimes="0;0.5;1" keySplines=".5 0 .5 1;.1 .8 .9 .2" '
    .. 'calcMode="spline" dur="2.2s"'),
  slide 'values="0;20" dur="0.6s" repeatCount="4" accumulate="sum" fill="freeze"',
  slide 'from="0" to="20" dur="1s" additive="sum" repeatDur="2.2s"',
  slide 'by="12" dur="0.5s" accumulate="sum" repeatCount="5" fill="freeze"',
  slide 'from="0" to="50" dur="2s" begin="-0.7s" fill="freeze"',
  slide 'from="0" to="50" dur="0.6s" begin="0.2s; 1.1s; 2s"',
  slide 'from="0" to="70" dur="3s" end="1.3s" fill="freeze"',
  slide 'from="0" to="60" dur="0.5s" min="1.2s" begin="0.3s"',
  slide 'from="0" to="60" dur="2s" max="1.2s" fill="freeze"',
  slide 'from="0" to="60" dur="1s" begin="0s; 0.5s; 1.5s" restart="whenNotActive"',
  slide 'from="0" to="60" dur="0.8s" begin="0s; 1s; 2s" restart="never"',
  -- one after another, in a circle
  { '<rect width="20" height="20" y="10" fill="#bc4749"><animate id="a" attributeName="x" '
    .. 'from="0" to="80" dur="0.5s" begin="0; c.end+0.1s"/></rect><rect width="20" height="20" '
    .. 'y="40" fill="#386641"><animate id="b" attributeName="x" from="0" to="80" dur="0.4s" '
    .. 'begin="a.end"/></rect><rect width="20" height="20" y="70" fill="#2a6f97"><animate id="c" '
    .. 'attributeName="x" from="0" to="80" dur="0.7s" begin="b.begin+0.2s"/></rect>' },
  -- what ends another, and what begins before the end of another
  { '<rect width="20" height="20" y="10" fill="#bc4749"><animate id="a" attributeName="x" '
    .. 'from="0" to="80" dur="2s" end="b.begin+0.3s" fill="freeze"/></rect><rect width="20" '
    .. 'height="20" y="40" fill="#386641"><animate id="b" attributeName="x" from="0" to="80" '
    .. 'dur="1s" begin="1s"/></rect><rect width="20" height="20" y="70" fill="#2a6f97"><animate '
    .. 'attributeName="x" from="0" to="80" dur="1s" begin="b.end-0.5s" fill="freeze"/></rect>' },
  box('<set attributeName="fill" to="#f2c14e" begin="0.4s" dur="1s"/>'
      .. '<set attributeName="visibility" to="hidden" begin="2s"/>'),
  dot('<animate attributeName="r" values="5;40;5" dur="2s"/><animate attributeName="fill" '
      .. 'values="#f00;#00f;lime" dur="3s"/>'),
  dot('<animate attributeName="fill" to="gold" dur="2s" fill="freeze"/><animate '
    .. 'attributeName="opacity" from="1" to=".2" dur="2s" begin="1s" fill="freeze"/>'),
  dot('<animate attributeName="stroke-width" from="0" to="16" dur="2s"/><animate '
    .. 'attributeName="stroke" from="#000" to="#0af" dur="2s"/>'),
  { '<path fill="none" stroke="#2a6f97" stroke-width="8" stroke-dasharray="200" '
    .. 'd="M10 80C20 0 80 0 90 80"><animate attributeName="stroke-dashoffset" from="200" to="0" '
    .. 'dur="2s" fill="freeze"/></path>' },
  { '<path fill="#386641" d="M10 10h80v80h-80z"><animate attributeName="d" dur="2s" '
    .. 'values="M10 10h80v80h-80z;M50 10h10v70h-50z;M10 10h80v80h-80z"/></path>' },
  { '<polygon fill="#bc4749" points="10,10 90,10 50,90"><animate attributeName="points" dur="2s" '
    .. 'from="10,10 90,10 50,90" to="50,10 90,90 10,90" fill="freeze"/></polygon>' },
  turn 'type="rotate" from="0 50 50" to="360 50 50" dur="2s" repeatCount="indefinite"',
  turn 'type="translate" values="0,0; 40,10; 0,40" dur="2s" additive="sum"',
  turn 'type="scale" from="1" to="1.8 .5" dur="2s" fill="freeze"',
  { BOX:format('<animateTransform attributeName="transform" type="skewX" from="0" to="40" '
    .. 'dur="2s"/><animateTransform attributeName="transform" type="skewY" from="0" to="20" '
    .. 'dur="2s" additive="sum"/>') },
  { '<g transform="translate(50 50)"><rect width="30" height="10" fill="#2a6f97" '
    .. 'transform="scale(1.5)"><animateTransform attributeName="transform" type="rotate" by="90" '
    .. 'dur="1s" accumulate="sum" repeatCount="3" fill="freeze"/></rect></g>' },
  fly 'path="M20 80C20 20 80 20 80 80" dur="2s" rotate="auto">',
  { '<path id="track" d="M20 20H80V80" fill="none" stroke="#bbb"/>'
    .. ARROW:format('<animateMotion dur="2s" rotate="auto-reverse" fill="freeze">'
      .. '<mpath href="#track"/></animateMotion>') },
  fly 'path="M20 50H80" keyPoints="0;0.8;0.2" keyTimes="0;0.5;1" calcMode="linear" dur="2s">',
  fly 'values="20,20; 80,30; 50,80" dur="2s" calcMode="linear" fill="freeze">',
  fly 'from="20,50" by="20,5" dur="0.8s" accumulate="sum" repeatCount="3" fill="freeze">',
  { '<linearGradient id="g"><stop offset="0" stop-color="#f00"><animate attributeName="stop-color" '
    .. 'values="#f00;#0f0" dur="2s"/></stop><stop offset=".5" stop-color="#00f"><animate '
    .. 'attributeName="offset" from=".2" to="1" dur="2s" fill="freeze"/></stop></linearGradient>'
    .. '<rect width="100" height="100" fill="url(#g)"/>' },
  { '<clipPath id="c"><circle cx="50" cy="50" r="20"><animate attributeName="r" to="45" dur="2s" '
    .. 'fill="freeze"/></circle></clipPath><g clip-path="url(#c)"><rect width="100" height="100" '
    .. 'fill="#2a6f97"/></g><use id="u" x="40" y="40"><animate attributeName="href" '
    .. 'values="#one;#two" dur="2s" repeatCount="indefinite"/></use><defs><rect id="one" '
    .. 'width="20" height="20" fill="gold"/><circle id="two" cx="10" cy="10" r="10" '
    .. 'fill="red"/></defs>' },
  -- an end that is known before the beginning, and one that comes too early
  lanes('id="a" dur="0.5s"', 'begin="1s" end="a.end+1.2s" dur="2s" fill="freeze"',
    'begin="0.2s; 1.1s" end="a.end-0.2s; 2s" dur="0.8s"'),
  -- beginnings before those that they follow
  lanes('id="a" begin="1.5s" dur="0.6s"', 'begin="a.begin-0.8s" dur="1s"',
    'begin="a.end-1.6s" dur="1.2s" fill="freeze"'),
  -- a beginning that moves back, because the end that it follows comes earlier
  lanes('id="a" begin="0.5s" dur="3s" end="c.begin; 9s"', 'begin="a.end-0.5s" dur="0.8s"',
    'id="c" begin="0s; 1.2s" dur="0.4s"'),
  lanes('begin="0.4s; 1s" end="0.6s; indefinite" dur="1s"',
    'begin="0.4s; 1s" end="0.6s" dur="1s" fill="freeze"',
    'begin="1s" end="1s; 2s" dur="1.5s" fill="freeze"'),
  lanes('id="a" begin="0s; b.end" dur="0.4s" restart="whenNotActive"',
    'id="b" begin="a.begin+0.3s" dur="0.5s"', 'begin="a.end" end="b.begin+0.3s" dur="2s"'),
  box('<animate attributeName="visibility" values="visible;hidden;visible;hidden;visible" '
    .. 'calcMode="paced" dur="2.4s"/>'),
  dot('<animate attributeName="fill" values="#000;#800000;#ff0" calcMode="paced" dur="2.4s"/>'),
  -- what is not given has an initial value, which differs
  { '<radialGradient id="g"><stop stop-color="#fff"/><stop offset="1" stop-color="#2a6f97"/>'
    .. '<animate attributeName="cx" to="10%" dur="2s" fill="freeze"/><animate attributeName="cy" '
    .. 'to="60%" dur="2s" fill="freeze"/><animate attributeName="r" to="90%" dur="2s" '
    .. 'fill="freeze"/></radialGradient><rect width="100" height="100" fill="url(#g)"/>' },
  { '<filter id="f" color-interpolation-filters="sRGB"><feComponentTransfer><feFuncR type="gamma">'
    .. '<animate attributeName="amplitude" to="0.2" dur="2s"/></feFuncR><feFuncG type="gamma">'
    .. '<animate attributeName="exponent" to="3" dur="2s"/></feFuncG></feComponentTransfer>'
    .. '</filter><rect width="100" height="100" fill="#c08040" filter="url(#f)"/>' },
  { '<g color="#386641" fill="gold"><g><rect width="60" height="60"><animate attributeName="fill" '
    .. 'to="currentColor" dur="2s"/></rect></g></g>' },
  turn 'type="scale" by="0.5" dur="0.8s" accumulate="sum" repeatDur="2.1s" fill="freeze"',
}

--- A box with a style, and keyframes.
local function styled(style, frames, shape)
  return { ("<style>@keyframes k{%s} .m{%s}</style>"):format(frames, style)
    .. (shape or '<rect class="m" x="20" y="30" width="30" height="24" fill="#2a6f97"/>') }
end

local SLIDE = "from{transform:translateX(0)} to{transform:translateX(45px)}"
local LINE = '<path class="m" fill="none" stroke="#bc4749" stroke-width="6" stroke-dasharray="200" '
  .. 'd="M10 80C20 0 80 0 90 80"/>'

moving.styles = {
  styled("animation: k 2s linear", SLIDE),
  styled("animation: k 2s", SLIDE),
  styled("animation: k 2s ease-in both", SLIDE),
  styled("animation: k 1s ease-out 2 forwards", SLIDE),
  styled("animation: k 1s ease-in-out infinite alternate", SLIDE),
  styled("animation: 0.8s cubic-bezier(.3,-.4,.7,1.4) 0.4s 2.5 both k", SLIDE),
  styled("animation: k 2s steps(4) forwards", SLIDE),
  styled("animation: k 2s steps(3, start)", SLIDE),
  styled("animation: k 2s steps(5, jump-none) infinite", SLIDE),
  styled("animation: k 1.1s linear infinite reverse", SLIDE),
  styled("animation: k .7s linear infinite alternate-reverse", SLIDE),
  styled("animation: k 2s linear 1s backwards", "from{fill:gold} to{fill:red}"),
  styled("animation: k 2s linear -1s forwards", SLIDE),
  styled("animation-name: k; animation-duration: 1500ms; animation-timing-function: linear; "
    .. "animation-iteration-count: 1.5; animation-fill-mode: forwards", SLIDE),
  styled("animation: k 2s linear; animation-delay: .5s", SLIDE),
  styled("animation: k 2s infinite", "0%,60%{opacity:1} 80%{opacity:.1} to{opacity:1}"),
  styled("animation: k 2s linear infinite", "50%{fill:#f00;transform:translate(30px,20px)}"),
  styled("animation: k 2s linear forwards", "from{stroke-dashoffset:200} to{stroke-dashoffset:0}",
    LINE),
  styled("animation: k 2s linear infinite; transform-origin: 50px 50px",
    "to{transform:rotate(360deg)}"),
  styled("animation: k 2s linear infinite; transform-origin: center",
    "from{transform:rotate(0) scale(1)} to{transform:rotate(180deg) scale(.5)}"),
  styled("animation: k 2s linear",
    "from{transform:none} to{transform:translate(20px,10px) rotate(45deg)}"),
  styled("animation: k 2s linear",
    "from{transform:rotate(30deg)} to{transform:translate(20px,10px) scale(1.5)}"),
  styled("animation: k 2s linear", "from{rotate:0deg;translate:0 0;scale:1} "
    .. "to{rotate:40deg;translate:30px 10px;scale:.6}"),
  styled("animation: k 2s", "from{cx:20px;r:5px} 40%{r:30px;animation-timing-function:linear} "
    .. "to{cx:80px;r:10px}", '<circle class="m" cy="50" fill="#386641"/>'),
  styled("animation: k 2s linear",
    [[from{d:path("M10 10H90V90H10Z")} to{d:path("M50 10H60V90H10Z")}]],
    '<path class="m" d="M10 10H90V90H10Z" fill="#bc4749"/>'),
  styled("animation: k 2s linear infinite, other 3s linear infinite",
    "to{transform:translateX(40px)}} @keyframes other{50%{fill:#f00;transform:none}"),
  styled("--far: 40px; animation: k 2s linear", "to{transform:translateX(var(--far))}"),
  styled("animation: k 2s linear forwards", "from{stroke:#000;stroke-width:1} "
    .. "to{stroke:#0af;stroke-width:14px}"),
  styled("animation: k 2s linear infinite", "from{visibility:visible} 50%{visibility:hidden}"),
  styled("animation: k 2s linear infinite; fill: rgba(255,0,0,.2)",
    "to{fill:rgba(0,0,255,1)}", '<rect class="m" width="90" height="90"/>'),
  styled("animation: k 2s linear paused; animation-delay: -0.7s", SLIDE),
  -- steps at their very beginning and end, forwards and backwards
  styled("animation: k 1s steps(3, start) 1.2s both", SLIDE),
  styled("animation: k 1s steps(3, end) reverse both", SLIDE),
  styled("animation: k 1s steps(3, start) 0.3s reverse both", SLIDE),
  styled("animation: k 0.5s steps(2, jump-both) 2 alternate both", SLIDE),
  styled("animation: k 2s linear; animation-timing-function: steps(2.5)", SLIDE),
  styled("animation: k 2s linear; animation-timing-function: steps(1, jump-none)", SLIDE),
  -- of frames at the same share the last one counts, and what is important does not
  styled("animation: k 2s linear infinite",
    "50%{transform:translateX(10px)} 50%{transform:translateX(45px)}"),
  styled("animation: k 2s linear",
    "50%{fill:red;transform:translateX(45px);animation-timing-function:step-end} 50%{fill:gold}"),
  styled("animation: k 2s linear", "from{transform:translateX(20px) !important} "
    .. "to{transform:translateX(45px); fill: red !important}"),
  styled("animation: k 2s linear; fill: #386641 !important", "to{fill:red;transform:scale(1.4)}"),
  { "<style>@keyframes k{50%{fill:currentColor}} .m{animation:k 2s linear}</style>"
    .. '<g color="#386641"><g fill="#f2c14e"><rect class="m" width="60" height="60"/></g></g>' },
  { "<style>@keyframes reverse2{to{transform:translateX(45px)}} .m{animation: reverse2 2s linear}"
    .. "@keyframes ease.2{to{x:0}} </style>" .. BOX:gsub("<rect ", '<rect class="m" '):format "" },
  styled("animation: k 2s linear; transform-box: view-box", "to{transform-origin:100px 100px;"
    .. "transform:rotate(40deg)}"),
  styled("animation: k 2s linear", "to{cx:80px;cy:60px;r:20px}", '<circle class="m" cy="20"/>'),
  -- added to the value without the animation
  styled("animation: k 2s linear; animation-composition: add; transform: rotate(20deg)",
    "to{transform:translate(40px,-20px)}"),
  styled("animation: k 2s linear; animation-composition: accumulate; transform: translate(9px,9px)"
    .. " scale(2)", "from{transform:translate(-20px,0) scale(.5)} to{transform:translate(9px,-20px)"
    .. " scale(.8)}"),
  styled("animation: k 2s linear, l 1.5s linear infinite; animation-composition: replace, add;"
    .. "stroke: red; stroke-width: 3px", "to{stroke-width:9px}} @keyframes l{50%{stroke-width:8px;"
    .. "transform:scale(.5)}"),
  styled("animation: k 2s linear; scale: 1.5; translate: 5px 9px; rotate: 10deg",
    "from{scale:.5;translate:20px;rotate:10deg;animation-composition:add} to{scale:2 1;"
    .. "translate:10px;rotate:40deg;animation-composition:add}"),
  styled("animation: k 2s linear; animation-composition: add; fill: #402010", "to{fill:#103050}"),
  -- about the box of the element
  styled("animation: k 2s linear infinite; transform-box: fill-box; transform-origin: center",
    "to{transform:rotate(360deg)}"),
  styled("animation: k 2s linear; transform-box: fill-box", "to{transform:rotate(90deg)}"),
  styled("animation: k 2s linear; transform-box: fill-box; transform-origin: 100% 0",
    "from{transform:translate(0,0) scale(.2)} to{transform:translate(50%,100%) scale(1.5)}"),
  styled("animation: k 2s linear infinite; transform-box: fill-box; transform-origin: 50% 50%",
    "to{transform:rotate(180deg)}", '<g class="m"><rect x="10" y="40" width="40" height="20"/>'
      .. '<circle cx="70" cy="50" r="20" fill="gold"/><rect class="m" x="65" y="30" '
      .. 'width="20" height="8" fill="red"/></g>'),
  styled("animation: k 2s linear", "to{translate:40px;scale:1.5 .5;rotate:20deg}"),
  styled("animation: k 2s linear", "from{translate:none;scale:2;rotate:none} 50%{scale:1 .5}"
    .. "to{translate:20px 40px;rotate:-30deg}"),
  styled("animation: k 2s linear infinite; transform-box: content-box; transform-origin: 25% 75%",
    "to{rotate:90deg;scale:1.5}", '<g transform="translate(10 5) rotate(10)"><rect class="m" '
      .. 'x="20" y="20" width="40" height="20" stroke="red" stroke-width="6"/></g>'),
}

--- An arrow about 0, 0 on a path.
local ARROWHEAD = '<path class="m" d="M-10 -6L10 0L-10 6Z" fill="#386641"/>'
local TRACK = [[offset-path:path("M20 80C20 20 80 20 80 80");]]
local RING = [[offset-path:path("M20 20H80V70H20Z");]]
local ALONG = "to{offset-distance:100%}"

local function along(style, frames, shape) return styled(style, frames, shape or ARROWHEAD) end

moving.paths = {
  styled("animation: k 2s linear(0, 0.9, 1)", SLIDE),
  styled("animation: k 2s linear(0, 0.25 50%, 1)", SLIDE),
  styled("animation: k 2s linear(0, 1 20% 60%, 0.5, 0.2, 1)", SLIDE),
  styled("animation: k 2s linear(20% 0, 80% 1)", SLIDE),
  styled("animation: k 2s linear(0.5 30%, 1 20%, 0 80%) both", SLIDE),
  styled("animation: k 2s linear(0, 0.5 40%, 0.9 40%, 1)", SLIDE),
  styled("animation: k 1s linear(0, -0.4 25%, 1.3 75%, 1) infinite alternate", SLIDE),
  styled("animation: k 2s linear(0 -20%, 1 120%)", SLIDE),
  styled("animation: k 2s linear(0.3)", SLIDE),
  styled("animation: k 2s linear; animation-timing-function: linear(0 10% 20% 30%, 1)", SLIDE),
  styled("animation: k 2s linear(0, 1 50%, 0.6) infinite, l 3s infinite linear(0,1,0)",
    SLIDE .. "} @keyframes l{to{fill:red}"),
  styled("animation: k 2s", "from{transform:none;animation-timing-function:linear(0,1 10%,0 60%,"
    .. "1)} 60%{transform:translateX(40px);animation-timing-function:linear(0 , 0.1, 1)}"),
  along(TRACK .. "animation: k 2s linear", ALONG),
  along(TRACK .. "animation: k 2s linear; offset-rotate: reverse", ALONG),
  along(TRACK .. "animation: k 2s linear; offset-rotate: 30deg", ALONG),
  along(TRACK .. "animation: k 2s linear; offset-rotate: auto 90deg", ALONG),
  along(TRACK .. "animation: k 2s linear; offset-distance: 20px", "to{offset-distance:60px}"),
  along(TRACK .. "animation: k 2s linear both",
    "from{offset-distance:-30%} to{offset-distance:150%}"),
  along(RING .. "animation: k 2s linear infinite", "to{offset-distance:100%}"),
  along(RING .. "animation: k 1s linear both",
    "from{offset-distance:-30%} to{offset-distance:170%}"),
  along(RING .. "animation: k 1s linear both", ALONG),
  along(TRACK .. "offset-distance:30%; animation: k 2s linear", "to{offset-rotate:auto 180deg}"),
  along(TRACK .. "offset-distance:30%; offset-rotate: 0deg; animation: k 2s linear",
    "to{offset-rotate:-90deg}"),
  along(TRACK .. "offset-distance:60%; animation: k 2s linear",
    [[to{offset-path:path("M20 20C20 80 80 80 80 20")}]]),
  along(TRACK .. "offset-distance:60%; animation: k 2s linear",
    [[to{offset-path:path("M20 20H80")}]]),
  along(TRACK .. "animation: k 2s linear; transform: scale(1.5) rotate(20deg)", ALONG),
  along(TRACK .. "animation: k 2s linear; transform: translate(5px, 9px)",
    "to{offset-distance:100%;transform:translate(-20px,0) scale(2)}"),
  along(TRACK .. "animation: k 2s linear; scale: .8; rotate: 30deg; translate: 9px 5px", ALONG),
  along(TRACK .. "animation: k 2s linear", ALONG,
    '<rect class="m" x="-9" y="-6" width="30" height="12" fill="#2a6f97"/>'),
  along(TRACK .. "animation: k 2s linear; transform-box: fill-box; transform-origin: center", ALONG,
    '<rect class="m" x="10" y="10" width="30" height="12" fill="#2a6f97"/>'),
  along(TRACK .. "animation: k 2s linear; transform-box: fill-box", ALONG,
    '<rect class="m" x="10" y="10" width="30" height="12" fill="#2a6f97"/>'),
  along(TRACK .. "animation: k 2s linear; transform-origin: 20px 10px; rotate: 30deg", ALONG,
    '<rect class="m" x="10" y="10" width="30" height="12" fill="#2a6f97"/>'),
  along(TRACK .. "animation: k 2s linear; offset-anchor: 20px 10px; transform: scale(.7)", ALONG,
    '<rect class="m" x="10" y="10" width="30" height="12" fill="#2a6f97"/>'),
  along(TRACK .. "animation: k 2s linear; offset-anchor: center; transform-box: fill-box", ALONG,
    '<rect class="m" x="10" y="10" width="30" height="12" fill="#2a6f97"/>'),
  along(TRACK .. "animation: k 2s linear; offset-anchor: auto", ALONG,
    '<g class="m" transform="scale(1.4)"><rect x="-9" y="-6" width="18" height="12"/></g>'),
  { "<style>@keyframes k{to{offset-distance:100%}} .m{" .. TRACK .. "animation:k 2s linear}</style>"
    .. '<g transform="translate(10 -5) rotate(10)">' .. ARROWHEAD .. "</g>" },
  along([[offset-path:path('M50 50a20 20 0 1 1 1 0 M10 10H60');animation:k 2s linear]], ALONG),
  along([[offset-path:path("M50 50H60M10 10H60z");animation:k 2s linear]], ALONG),
  along([[offset-path:path(evenodd, "M50 50H60");animation:k 2s linear]], ALONG),
  along([[offset-path:path("M10 10H60 X");animation:k 2s linear]], ALONG),
  along(TRACK .. "offset-distance: 50; animation:k 2s linear", "to{transform:translate(5px,3px)}"),
  along(TRACK .. "animation: k 2s linear", "50%{offset-path:none} to{offset-distance:100%}"),
}

moving.times = { 0.13, 0.57, 1.06, 1.63, 2.37 }

function moving.document(scene)
  return '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100">'
    .. scene[1] .. "</svg>"
end

return moving
