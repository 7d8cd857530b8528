#!/usr/bin/env python3
"""Writes the golden scan bundle, straight from the text of the format and with zlib's CRC-32: an
expectation that owes nothing to the code under test. Run it in its own folder."""

import struct
import zlib

FRAMES, WIDTH, HEIGHT, STRIDE = 10, 18, 16, 20
PADDING = 0xEE


def row(frame, y):
    pixels = bytes((37 * frame + 11 * y + 5 * x) % 256 for x in range(WIDTH))
    return pixels + bytes([PADDING] * (STRIDE - WIDTH))


pixels = b"".join(row(f, y) for f in range(FRAMES) for y in range(HEIGHT))
header = struct.pack(
    "<8sHHIIIIIQQI8x",
    b"FSCANBIN", 1, 64, 0x59455247, FRAMES, WIDTH, HEIGHT, STRIDE,
    1735689600123456789, 16666667, zlib.crc32(pixels))
header += struct.pack("<I", zlib.crc32(header))

# A document as another tool may write it: byte-order mark, CRLF, single quotes, attributes and
# elements in another order, comments, processing instructions, CDATA, things that we do not know.
document = """<?xml version='1.0' encoding='utf-8' standalone='yes'?>
<!-- made by hand & <not> by facescan -->
<?editor fold="all"?>
<facescan  version='1' serial='F&amp;S-0007' xmlns:lab='urn:lab'>
  <lab:exposure unit='ms'>8.3</lab:exposure>
  <calibration units='mm' degree='2' model='polynomial' date='2026-01-01'>
    <range max='5.2e2' min='300'/>
    <output name='Z'>
      400 -1.5 2.25 -3.125
      <!-- the rest in
           two lines -->
      4e-1 5E+1 .5
      -6. 0 -0
    </output>
    <output name='X'><![CDATA[1 2 3 4 5]]> <![CDATA[6 7 8 9 10]]></output>
    <output name='Y'>1e-3\t2e-3 3e-3 4<?pause?>e-3 5e-3 6e-3
7e-3 8e-3 9e-3 &#49;0e-3</output>
    <input scale='-9' offset='8.5' name='x'/>
    <input name='code' scale='8' offset='8'></input>
    <input name='y' offset='7.5' scale='8'/>
  </calibration>
  <pattern order='grouped' axis='x' bits='4' type='gray' ><note><frames/></note></pattern>
  <image height='16' width='17' y='0' x='1'/>
  <frames count='8' first='1' file='frames.bin'/>
</facescan>
<!-- end -->
"""

with open("frames.bin", "wb") as file:
    file.write(header + pixels)
with open("scan.xml", "wb") as file:
    file.write(b"\xef\xbb\xbf" + document.replace("\n", "\r\n").encode("utf-8"))
