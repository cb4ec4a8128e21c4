"use client";

import * as hpr from "hidden-point-removal";
import * as lite from "hidden-point-removal/lite";
import * as worker from "hidden-point-removal/worker";
import { useEffect } from "react";
import { answerWithLite } from "../shared/answer.js";
import { show } from "../shared/show.js";

/** Answers in the page and in workers, and compares both with the server's answers. */
export function InBrowser({ server }) {
  useEffect(() => {
    void show(
      answerWithLite(hpr, worker, lite).then((browser) => {
        const all = [server.here, server.there, browser.here, browser.there].map(String);
        if (all.some((one) => one !== all[0])) throw new Error("the server and the page disagree");
        return browser;
      }),
    );
  }, [server]);
  return <output />;
}
