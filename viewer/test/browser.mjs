// SPDX-License-Identifier: Apache-2.0
//
// Opens a report in a real browser without a window: at the widths of a desktop and a phone, with everything but the
// file itself cut off. Fails on an error in the console, a request, a view that is empty or does not play, a list that
// is not complete.
//
//   node browser.mjs CHROMIUM REPORT.html SCREENSHOTS [--expect JSON]
//
// JSON: {"listed": n, "says": ["text", ...], "lacks": [...], "word": "text", "tone": "text", "plots": n, "frames": n, "most_open_seconds": s}
import { createRequire } from "node:module";
import { mkdirSync, writeFileSync } from "node:fs";
import { basename, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const { default: puppeteer } = await import(pathToFileURL(createRequire(`${process.cwd()}/`).resolve("puppeteer-core")));

const [chromium, report, folder, , expectation = "{}"] = process.argv.slice(2);
const expected = JSON.parse(expectation);
const widths = { desktop: [1280, 900], phone: [390, 844] };
const failures = [];
const expect = (holds, what) => {
  if (!holds) failures.push(what);
};

/** How many of the sampled pixels of the view are not its ground. */
async function drawnShare(page) {
  return page.evaluate(async () => {
    const { view } = await window.noliReport;
    view.draw();
    const from = view.renderer.domElement;
    const canvas = Object.assign(document.createElement("canvas"), { width: 200, height: 150 });
    const context = canvas.getContext("2d");
    context.drawImage(from, 0, 0, 200, 150);
    const { data } = context.getImageData(0, 0, 200, 150);
    let other = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) + Math.abs(data[i + 2] - data[2]) > 12) ++other;
    }
    return other / (data.length / 4);
  });
}

/** Frames drawn in a second while it plays, as fast as the browser asks for them. */
async function framesPerSecond(page) {
  return page.evaluate(async () => {
    const { view, player } = await window.noliReport;
    const began = performance.now();
    let frames = 0;
    await new Promise((done) => {
      const next = () => {
        player.go((player.frame + 1) % player.times.length);
        ++frames;
        if (performance.now() - began > 2000) done();
        else requestAnimationFrame(next);
      };
      requestAnimationFrame(next);
    });
    return (1000 * frames) / (performance.now() - began);
  });
}

async function look(browser, name, [width, height]) {
  const page = await browser.newPage();
  await page.bringToFront();
  await page.setViewport({ width, height, isMobile: name === "phone", hasTouch: name === "phone" });
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text())) failures.push(`${name}: console: ${message.text()}`);
  });
  page.on("pageerror", (error) => failures.push(`${name}: ${error.message}`));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) failures.push(`${name}: asked for ${request.url()}`);
  });
  const began = Date.now();
  await page.goto(pathToFileURL(resolve(report)).href, { waitUntil: "load" });
  await page.waitForSelector("body[data-ready]", { timeout: 60000 });
  const seconds = (Date.now() - began) / 1000;
  const found = await page.evaluate(async () => {
    const { view, player } = await window.noliReport;
    return {
      word: document.querySelector(".badge").textContent,
      tone: document.querySelector(".badge").className.replace("badge ", ""),
      text: document.body.innerText,
      listed: document.querySelectorAll("tr.pick").length,
      plots: document.querySelectorAll(".plot canvas").length,
      frames: player ? player.times.length : 0,
      view: Boolean(view),
      wide: document.documentElement.scrollWidth - window.innerWidth,
    };
  });
  expect(found.wide <= 0, `${name}: the page is ${found.wide} pixels too wide`);
  for (const key of ["word", "tone", "listed", "plots", "frames"]) {
    if (key in expected) expect(found[key] === expected[key], `${name}: ${key}: expected ${expected[key]}, found ${found[key]}`);
  }
  for (const text of expected.says ?? []) expect(found.text.includes(text), `${name}: the page does not say ${text}`);
  for (const text of expected.lacks ?? []) expect(!found.text.includes(text), `${name}: the page says ${text}`);
  if ("most_open_seconds" in expected) expect(seconds <= expected.most_open_seconds, `${name}: opened in ${seconds} s`);
  const result = { name, open_seconds: seconds, frames: found.frames, listed: found.listed, plots: found.plots };
  if (found.view) {
    const share = await drawnShare(page);
    expect(share > 0.005, `${name}: the view is empty (${share})`);
    result.drawn_share = share;
    if (found.frames > 1) {
      result.frames_per_second = await framesPerSecond(page);
      const label = () => page.$eval("output", (node) => node.textContent);
      const before = await label();
      await page.click(".controls button");
      const plays = await page.waitForFunction((text) => document.querySelector("output").textContent !== text,
                                               { timeout: 30000, polling: 100 }, before).then(() => true, () => false);
      expect(plays, `${name}: it does not play: ${before}, then ${await label()}, ${await page.$eval(".controls button", (b) => b.textContent)}`);
      await page.$eval(".controls button", (button) => { if (button.textContent === "Pause") button.click(); });
    }
  }
  if (found.listed > 0) {
    await page.click("tr.pick");
    expect(await page.$("tr.picked"), `${name}: a contact cannot be picked`);
  }
  const closed = await page.$("tr.nested details:not([open])");
  if (closed) {
    await closed.evaluate((details) => { details.open = true; });
    const filled = await page.waitForFunction((details) => details.querySelector("td"), { timeout: 10000, polling: 100 }, closed)
      .then(() => true, () => false);
    expect(filled, `${name}: a table in a row stays empty`);
  }
  await page.screenshot({ path: `${folder}/${basename(report, ".html")}-${name}.png`, fullPage: true });
  await page.close();
  return result;
}

mkdirSync(folder, { recursive: true });
const browser = await puppeteer.launch({
  executablePath: chromium,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--host-resolver-rules=MAP * ~NOTFOUND"],
});
const results = [];
try {
  for (const [name, size] of Object.entries(widths)) results.push(await look(browser, name, size));
} finally {
  await browser.close();
}
writeFileSync(`${folder}/${basename(report, ".html")}.json`, JSON.stringify(results, null, 2));
console.log(JSON.stringify(results));
for (const failure of failures) console.error(failure);
process.exit(failures.length > 0 ? 1 : 0);
