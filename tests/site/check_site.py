# SPDX-License-Identifier: BSD-3-Clause
"""The site in headless Chromium: check_site.py SITE PICTURES

On the page of each material the sliders are moved, at last by the keyboard, and the numbers that
the page shows are compared with the library. No page is wider than its window, and none asks for
what is not there. Needs Debian's chromium, chromium-driver and python3-selenium.
"""
import random
import shutil
import sys
import warnings
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

import restitute

WIDTHS = (1280, 390)
PICTURES = ("index", "README", "docs/README", "docs/theory", "docs/gallery", "docs/python", "docs/table",
            "examples/lammps/README", "examples/python/from_a_drop_test_to_a_map", "reference/python",
            "reference/c", "include/restitute/restitute.h", "materials/polyisobutylene", "materials/steel")
SETTINGS = 6  # a material


def browser():
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    options.binary_location = shutil.which("chromium")
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def sized(driver, width, height=900):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})


def set_slider(driver, key, draw):
    """A slider near a random place, and from there by the keyboard."""
    slider = driver.find_element(By.ID, f"impact-{key}")
    place = draw.randint(1, int(slider.get_attribute("max")) - 1)
    driver.execute_script("arguments[0].value = arguments[1]", slider, place)
    step = draw.choice((-1, 1))
    slider.send_keys(Keys.ARROW_RIGHT if step > 0 else Keys.ARROW_LEFT)
    assert int(slider.get_attribute("value")) == place + step, key


def shown(driver):
    """The numbers of the page, and the impact they are of."""
    data = driver.execute_script("return {...document.getElementById('impact-numbers').dataset}")
    passed = data.pop("passed").split()
    numbers = {name: float(value) for name, value in data.items()}
    impact = {name: numbers.pop(name) for name in ("radius", "density", "speed", "angle", "friction")}
    return impact, numbers, passed


def check_material(driver, page, draw):
    """Compares some settings of a page; returns the largest differences."""
    material, worst = restitute.material(page.stem), {"ez": 0.0, "ex": 0.0}
    driver.get(page.as_uri())
    error = driver.execute_script("return JSON.parse(document.getElementById('impact-table').textContent).error")
    for _ in range(SETTINGS):
        ball = Select(driver.find_element(By.ID, "impact-ball"))
        ball.select_by_index(draw.randrange(len(ball.options)))
        for key in ("radius", "speed", "angle", "friction"):
            set_slider(driver, key, draw)
        impact, numbers, passed = shown(driver)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", restitute.ModelLimitWarning)
            exact = restitute.pair(material, method="sync", tolerance=1e-6, **impact)
        for key, value in worst.items():
            difference = abs(numbers[key] - float(getattr(exact, key)))
            worst[key] = max(value, difference)
            assert difference <= error[key], (page.stem, impact, key, difference, error)
        for key, name in (("radius", "radius_ratio"), ("speed", "speed_ratio"), ("displacement", "displacement_ratio")):
            limit, value = getattr(exact.settings, f"{key}_limit"), float(getattr(exact, name))
            if abs(value - limit) > 0.01 * limit:  # nearer, the interpolation decides
                assert (key in passed) == (value > limit), (page.stem, impact, key, value)
        text = driver.find_element(By.ID, "impact-numbers").text
        assert f"{numbers['ez']:.3f}" in text and ("Beyond" in text) == bool(passed), text
    return worst


def take_pictures(driver, site, folder):
    """Pictures of pages at both widths; none is wider than its window."""
    for name in (name for name in PICTURES if (site / f"{name}.html").exists()):
        for width in WIDTHS:
            sized(driver, width)
            driver.get((site / f"{name}.html").as_uri())
            wide, high = driver.execute_script("const e = document.documentElement; return [e.scrollWidth, e.scrollHeight]")
            assert wide <= width, f"{name} is {wide} wide in a window of {width}"
            sized(driver, width, min(high, 3000))
            driver.save_screenshot(str(folder / f"{name.replace('/', '-')}-{width}.png"))


def main(site, folder):
    if not all(map(shutil.which, ("chromium", "chromedriver"))):
        sys.exit("check_site: needs chromium and chromedriver (Debian: chromium, chromium-driver)")
    folder.mkdir(parents=True, exist_ok=True)
    draw, driver = random.Random(2017), browser()
    try:
        sized(driver, WIDTHS[0])
        for page in sorted((site / "materials").glob("*.html")):
            worst = check_material(driver, page, draw)
            print(f"{page.stem}: {SETTINGS} settings, differences up to {worst['ez']:.1g} in ez and {worst['ex']:.1g} in ex")
        take_pictures(driver, site, folder)
        complaints = [entry["message"] for entry in driver.get_log("browser") if entry["level"] != "INFO"]
        assert not complaints, complaints
    finally:
        driver.quit()
    print(f"pictures: {folder}")


main(*(Path(word).resolve() for word in sys.argv[1:3]))
