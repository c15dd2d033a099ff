"""A sheet as a PNG picture: its PDF, rendered by PDFium. The same sheet is the same bytes."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO

from PIL.Image import Image
from PIL.PngImagePlugin import PngInfo
from pypdfium2 import PdfDocument

from graphplan.output.pdf import pdf
from graphplan.sheet.plates.display import Sheet

INCH = 25.4  # mm
ROUNDED_UP_PX = 0.1  # pixels by which PDFium, which rounds up, is asked for less


def png(sheet: Sheet, dpi: float = 150) -> bytes:
    """The sheet as a picture of so many dots per inch.

    Fails with `Refused` where the sheet has letters that the font does not.
    """
    written, about = BytesIO(), PngInfo()
    about.add_text("Title", sheet.title)
    about.add_text("Software", "graphplan")
    picture(sheet, dpi / INCH).save(written, "PNG", dpi=(dpi, dpi), pnginfo=about)
    return written.getvalue()


def picture(sheet: Sheet, scale: float) -> Image:
    """The sheet in so many pixels per mm, its sides rounded to whole ones."""
    wide, high = round(sheet.width * scale), round(sheet.height * scale)
    page = PdfDocument(pdf([replace(sheet, width=wide / scale, height=high / scale)]))[0]
    image: Image = page.render(scale=(wide - ROUNDED_UP_PX) / page.get_width()).to_pil()
    return image
