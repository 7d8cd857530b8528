#!/usr/bin/env python3
"""Writes the seeds of the fuzz targets. Run it in its own folder."""

import struct
import zlib


def frames_bin(name, frames=1, width=16, height=16, stride=16, **changes):
    pixels = bytes((7 * i) % 256 for i in range(frames * height * stride))
    fields = dict(magic=b"FSCANBIN", version=1, size=64, format=0x59455247, start=0, interval=0,
                  pixel_crc=zlib.crc32(pixels), reserved=bytes(8), cut=None, more=b"")
    fields.update(changes)
    header = struct.pack(
        "<8sHHIIIIIQQI8s", fields["magic"], fields["version"], fields["size"], fields["format"],
        frames, width, height, stride, fields["start"], fields["interval"], fields["pixel_crc"],
        fields["reserved"])
    header += struct.pack("<I", fields.get("header_crc", zlib.crc32(header)))
    with open("frames_bin/" + name, "wb") as file:
        file.write((header + pixels + fields["more"])[:fields["cut"]])


frames_bin("smallest")
frames_bin("padded", width=17, stride=24, start=1735689600000000000, interval=16666667)
frames_bin("several", frames=3)
frames_bin("cut_in_header", cut=40)
frames_bin("cut_in_pixels", cut=200)
frames_bin("trailing", more=b"\0")
frames_bin("bad_pixel_crc", pixel_crc=1)
frames_bin("bad_header_crc", header_crc=1)
frames_bin("reserved", reserved=b"\1" + bytes(7))
frames_bin("version_2", version=2)

CALIBRATION = """  <calibration model="polynomial" degree="1" units="mm">
    <input name="x" offset="8" scale="9"/>
    <input name="y" offset="7.5" scale="-8e0"/>
    <input name="code" offset="8" scale="8"/>
    <output name="X">0.5 -1 2e1 3</output>
    <output name="Y">1 2 3 4</output>
    <output name="Z">400 0 0 1e-3</output>
    <range min="300" max="520"/>
  </calibration>
"""
SCAN = """<?xml version="1.0" encoding="UTF-8"?>
<facescan version="1">
  <frames file="frames.bin" first="0" count="8"/>
  <image x="0" y="0" width="16" height="16"/>
  <pattern type="gray" bits="4" axis="y" order="interleaved"/>
""" + CALIBRATION + "</facescan>\n"


def scan_xml(name, text):
    with open("scan_xml/" + name, "wb") as file:
        file.write(text if isinstance(text, bytes) else text.encode("utf-8"))


scan_xml("plain", SCAN)
scan_xml("tight", "".join(line.strip() for line in SCAN.splitlines()[1:]))
scan_xml("byte_order_mark", b"\xef\xbb\xbf" + SCAN.encode())
scan_xml("single_quotes", SCAN.replace('"', "'"))
scan_xml("comments", SCAN.replace("<image", "<!-- a\n<b> --><?p q?><image"))
scan_xml("cdata", SCAN.replace("1 2 3 4", "<![CDATA[1 2]]> <![CDATA[3 4]]>"))
scan_xml("references", SCAN.replace('"8"/>', '"&#x38;"/>').replace("gray", "gr&#97;y"))
scan_xml("unknown", SCAN.replace("<image", "<device serial='7'><a>b</a></device><image"))
scan_xml("degree_2", SCAN.replace('degree="1"', 'degree="2"').replace("1 2 3 4", "1 " * 10)
         .replace("0.5 -1 2e1 3", "2 " * 10).replace("400 0 0 1e-3", "-3e-3 " * 10))
scan_xml("bits_12", SCAN.replace('bits="4"', 'bits="12"').replace('"8"/>', '"24"/>', 1))
scan_xml("doctype", SCAN.replace("<facescan", "<!DOCTYPE a [<!ENTITY b 'c'>]><facescan", 1))
scan_xml("zero_reference", SCAN.replace('count="8"', 'count="8&#0;"'))
scan_xml("deep", SCAN.replace("<image", "<a>" * 200 + "</a>" * 200 + "<image"))
scan_xml("not_utf8", SCAN.encode().replace(b"gray", b"gr\xe4y"))
scan_xml("cut", SCAN[:400])
scan_xml("empty", "")
