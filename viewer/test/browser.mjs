// SPDX-License-Identifier: Apache-2.0
//
// Opens a report in a real browser without a window: at the widths of a desktop and a phone, with everything but the
// file itself cut off. Fails on a warning in the console, a request, raw JSON, a view that is empty or does not play, a
// list that is not complete, and on a phone on anything to touch that is lower than 40 pixels.
//
//   node browser.mjs CHROMIUM REPORT.html SCREENSHOTS [--expect JSON]
//
// JSON:
//   word, tone, listed, plots, frames    what the page has
//   says, lacks                          texts that are, or are not, anywhere
//   shows, folds                         texts that are, or are not, seen without unfolding anything
//   meets                                the least share of the view's pixels with the colours of what meets, seen
//                                        without a click or scrolling; 0: none have
//   last_mark                            text below the view after a click on the last mark of the time line
//   warns                                a warning in the console that has to come
//   most_open_seconds                    until the page is there
import { createRequire } from "node:module";
import { mkdirSync, writeFileSync } from "node:fs";
import { basename, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const { default: puppeteer } = await import(
  pathToFileURL(createRequire(`${process.cwd()}/`).resolve("puppeteer-core"))
);

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

/** The share of pixels with the colours of faces that meet (src/colours.js), of what is seen of the view without scrolling. */
async function meetingShare(page) {
  const clip = await page.$eval(".stage", (stage) => {
    const { x, y, width, bottom } = stage.getBoundingClientRect();
    return { x, y, width, height: Math.min(bottom, innerHeight) - y };
  });
  if (clip.height < 100) return 0;
  const image = await page.screenshot({ encoding: "base64", clip });
  return page.evaluate(async (data) => {
    const picture = new Image();
    picture.src = `data:image/png;base64,${data}`;
    await picture.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: picture.width, height: picture.height });
    const context = canvas.getContext("2d");
    context.drawImage(picture, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, picture.width, picture.height);
    const near = (i, colour) => colour.every((c, k) => Math.abs(pixels[i + k] - c) < 12);
    let count = 0;
    for (let i = 0; i < pixels.length; i += 4) if (near(i, [0xd8, 0x10, 0x2a]) || near(i, [0xff, 0xa4, 0x00])) ++count;
    return count / (pixels.length / 4);
  }, image);
}

/** What meets is seen at once; and what is counted is gone when it is not drawn, so that this test can fail. */
async function lookAtMeeting(page, name) {
  const seen = await meetingShare(page);
  expect(
    expected.meets === 0 ? seen === 0 : seen >= expected.meets,
    `${name}: ${seen} of the view has the colours of what meets, expected ${expected.meets}`,
  );
  await page.evaluate(async () => {
    const { view } = await window.noliReport;
    view.choose(null);
    await view.changed();
  });
  const without = await meetingShare(page);
  expect(without === 0, `${name}: ${without} of the view has the colours of what meets, though nothing is highlighted`);
  await page.evaluate(async () => {
    const { view, stage } = await window.noliReport;
    if (stage.chosen) view.choose(stage.chosen);
    await view.changed();
  });
  return seen;
}

/** On a phone. */
async function lookAtTargets(page, name) {
  const low = await page.$$eval(
    "button, select, tr.pick, .marks, .timeline input, .controls label, header summary, section > details > summary",
    (list) =>
      list
        .filter((node) => node.offsetParent && node.getBoundingClientRect().height < 40)
        .map((node) => `${node.className || node.tagName} ${node.textContent.slice(0, 20)}`),
  );
  expect(low.length === 0, `${name}: lower than 40 pixels: ${[...new Set(low)].slice(0, 5).join("; ")}`);
}

/** A click on a contact, and what keys do in the list. */
async function lookAtList(page, name) {
  const { chosen, last } = await page.evaluate(async () => {
    const { stage } = await window.noliReport;
    return {
      chosen: stage ? stage.list.indexOf(stage.chosen) : null,
      last: document.querySelectorAll("tr.pick").length - 1,
    };
  });
  if (chosen !== null) expect(chosen === 0, `${name}: it opens with contact ${chosen + 1}, not with the first`);
  await page.$eval(`tr.pick:nth-child(${Math.min(last, 3) + 1})`, (row) =>
    row.scrollIntoView({ block: "center", behavior: "instant" }),
  );
  await page.click(`tr.pick:nth-child(${Math.min(last, 3) + 1})`);
  expect(await page.$(`tr.picked:nth-child(${Math.min(last, 3) + 1})`), `${name}: a contact cannot be picked`);
  if (chosen === null) return;
  const inView = await page
    .waitForFunction(
      () => {
        const { top, bottom } = document.querySelector(".stage").getBoundingClientRect();
        return top >= 0 && bottom <= innerHeight;
      },
      { timeout: 5000, polling: 100 },
    )
    .then(
      () => true,
      () => false,
    );
  expect(inView, `${name}: a click on a contact does not bring the view to the screen`);
  if (last === 0) return;
  await page.focus("tr.picked");
  for (const key of ["Home", "ArrowDown", "Enter"]) await page.keyboard.press(key);
  expect(await page.$("tr.picked:nth-child(2)"), `${name}: keys do not pick the second contact`);
}

async function lookAtMarks(page, name) {
  const before = await page.$eval(".caption", (node) => node.textContent);
  await page.$eval(".marks", (node) => node.scrollIntoView({ block: "center", behavior: "instant" }));
  const bars = await page.$$(".marks .bar");
  await bars[bars.length - 1].click();
  const after = await page.$eval(".caption", (node) => node.textContent);
  expect(after !== before && after.includes(expected.last_mark), `${name}: the last mark shows ${after}`);
}

/** All texts, those too that are folded, except for tables within tables. */
async function wholeText(page) {
  for (let depth = 0; depth < 3; ++depth) {
    await page.$$eval("details", (list) =>
      list
        .filter((d) => !d.closest("td"))
        .forEach((d) => {
          d.open = true;
        }),
    );
    await new Promise((done) => setTimeout(done, 100));
  }
  return page.evaluate(() => document.body.innerText);
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
  let warned = false;
  page.on("console", (message) => {
    if (!["error", "warn", "warning"].includes(message.type()) || /GPU stall|GL Driver Message/.test(message.text()))
      return;
    if (expected.warns && message.text().includes(expected.warns)) warned = true;
    else failures.push(`${name}: console: ${message.text()}`);
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
      seen: document.body.innerText,
      listed: document.querySelectorAll("tr.pick").length,
      plots: document.querySelectorAll(".plot canvas").length,
      frames: player ? player.times.length : 0,
      view: Boolean(view),
      wide: document.documentElement.scrollWidth - window.innerWidth,
    };
  });
  expect(found.wide <= 0, `${name}: the page is ${found.wide} pixels too wide`);
  for (const key of ["word", "tone", "listed", "plots", "frames"]) {
    if (key in expected)
      expect(found[key] === expected[key], `${name}: ${key}: expected ${expected[key]}, found ${found[key]}`);
  }
  for (const text of expected.shows ?? []) expect(found.seen.includes(text), `${name}: one does not see ${text}`);
  for (const text of expected.folds ?? [])
    expect(!found.seen.includes(text), `${name}: one sees ${text} without unfolding it`);
  if (expected.warns) expect(warned, `${name}: no warning about ${expected.warns}`);
  if ("most_open_seconds" in expected) expect(seconds <= expected.most_open_seconds, `${name}: opened in ${seconds} s`);
  const result = { name, open_seconds: seconds, frames: found.frames, listed: found.listed, plots: found.plots };
  await page.screenshot({ path: `${folder}/${basename(report, ".html")}-${name}-opened.png` });
  if (found.view && "meets" in expected) result.meets = await lookAtMeeting(page, name);
  if (name === "phone") await lookAtTargets(page, name);
  if (found.view) {
    const share = await drawnShare(page);
    expect(share > 0.005, `${name}: the view is empty (${share})`);
    result.drawn_share = share;
    if (found.frames > 1) {
      result.frames_per_second = await framesPerSecond(page);
      const label = () => page.$eval("output", (node) => node.textContent);
      const before = await label();
      await page.click(".play");
      const plays = await page
        .waitForFunction(
          (text) => document.querySelector("output").textContent !== text,
          { timeout: 30000, polling: 100 },
          before,
        )
        .then(
          () => true,
          () => false,
        );
      expect(
        plays,
        `${name}: it does not play: ${before}, then ${await label()}, ${await page.$eval(".play", (b) => b.textContent)}`,
      );
      await page.$eval(".play", (button) => {
        if (button.textContent === "Pause") button.click();
      });
    }
  }
  if (found.listed > 0) await lookAtList(page, name);
  if ("last_mark" in expected) await lookAtMarks(page, name);
  const text = await wholeText(page);
  for (const one of expected.says ?? []) expect(text.includes(one), `${name}: the page does not say ${one}`);
  for (const one of expected.lacks ?? []) expect(!text.includes(one), `${name}: the page says ${one}`);
  const raw = text.match(/[{[]\s*"[^"]*"\s*[:,]/);
  expect(!raw, `${name}: the page has raw JSON: ${raw}`);
  const closed = await page.$("tr.nested details:not([open])");
  if (closed) {
    await closed.evaluate((details) => {
      details.open = true;
    });
    const filled = await page
      .waitForFunction((details) => details.querySelector("td"), { timeout: 10000, polling: 100 }, closed)
      .then(
        () => true,
        () => false,
      );
    expect(filled, `${name}: a table in a row stays empty`);
  }
  await page.screenshot({ path: `${folder}/${basename(report, ".html")}-${name}.png`, fullPage: true });
  await page.close();
  return result;
}

mkdirSync(folder, { recursive: true });
const browser = await puppeteer.launch({
  executablePath: chromium,
  args: [
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--host-resolver-rules=MAP * ~NOTFOUND",
  ],
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
