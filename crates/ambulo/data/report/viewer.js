// Built from viewer/ by `npm run build`; do not edit. Sources: fnv1a64 42638f7db64c73cf
"use strict";(()=>{var s=class{start;end;step;#r;#e=!1;#o=1;#t=null;#i=new Set;constructor(e){this.start=e.start_s,this.step=e.step_s,this.end=e.start_s+e.step_s*Math.max(e.frames-1,0),this.#r=this.start}get time(){return this.#r}get playing(){return this.#e}get speed(){return this.#o}set speed(e){this.#o=e,this.#n()}play(){this.#e||this.end<=this.start||(this.#e=!0,this.#t=null,requestAnimationFrame(this.#s),this.#n())}pause(){this.#e=!1,this.#n()}toggle(){this.#e?this.pause():this.play()}seek(e){Number.isFinite(e)&&(this.#r=Math.min(Math.max(e,this.start),this.end),this.#n())}nudge(e){this.#e=!1;let n=Math.round((this.#r-this.start)/this.step)+e;this.seek(this.start+n*this.step)}subscribe(e){return this.#i.add(e),()=>this.#i.delete(e)}#s=e=>{if(!this.#e)return;let n=this.#t===null?0:Math.min((e-this.#t)/1e3,.25);this.#t=e;let t=this.#r+n*this.#o;this.seek(t>this.end?this.start:t),requestAnimationFrame(this.#s)};#n(){for(let e of this.#i)e(this)}};var a=class r{#r;#e=new Map;constructor(e){this.#r=e}static async decode(e){return new r(A(await w(x(e.trim()))))}read(e){let n=this.#e.get(e);if(n)return n;let t=this.#r.subarray(e.at,e.at+e.count);if(t.length!==e.count)throw new Error(`The page's numbers end at ${this.#r.length}, a series needs ${e.at+e.count}.`);let o=Float64Array.from(t,i=>i===65535?Number.NaN:e.low+e.step*i);return this.#e.set(e,o),o}};function x(r){let e=atob(r),n=new Uint8Array(e.length);for(let t=0;t<e.length;t++)n[t]=e.charCodeAt(t);return n}async function w(r){let e=new Blob([r]).stream().pipeThrough(new DecompressionStream("deflate"));return new Uint8Array(await new Response(e).arrayBuffer())}function A(r){let e=r.length>>1,n=new Uint16Array(e),t=0;for(let o=0;o<e;o++)t=t+(r[o]??0)+256*(r[e+o]??0)&65535,n[o]=t;return n}async function c(){let r=S(m("ambulo-page"));if(typeof DecompressionStream>"u")throw new Error("This browser is too old for the report: it cannot unpack the page's numbers. Please use Chrome or Edge 80, Safari 16.4, Firefox 113, or a later one.");return{page:r,numbers:await v(m("ambulo-numbers"))}}function S(r){let e;try{e=JSON.parse(r)}catch{throw new Error("The data of this report cannot be read: the file seems to be cut off or changed.")}if(e.format!==1)throw new Error(`The data of this report have format ${e.format}, its viewer needs ${1}.`);return e}async function v(r){try{return await a.decode(r)}catch{throw new Error("The numbers of this report cannot be unpacked: the file seems to be cut off or changed.")}}function m(r){let e=document.getElementById(r)?.textContent??"";if(e.trim()==="")throw new Error("This file holds no report: its data are missing.");return e}var d={note:"Looks of the report page and the figures; the one place for them. Colours: Okabe and Ito's palette for colour-blind eyes (unverified), `dark` on dark ground. Dashes in lengths of a line's width 1.5 pt, [] is solid. Lines and fonts in points (1/72 inch).",right:{color:"#0072B2",dark:"#56B4E9",dash:[]},left:{color:"#D55E00",dark:"#F0893A",dash:[3,1.6]},band:{color:"#D9D9D9",dark:"#3A3F45",opacity:1},uncertainty_opacity:.18,infeasible:{color:"#C00018",dark:"#FF5A5F"},measured:{color:"#000000",dark:"#F2F2F2"},text:{color:"#1A1A1A",dark:"#ECECEC"},quiet:{color:"#5A5A5A",dark:"#B0B5BA"},grid:{color:"#E4E4E4",dark:"#2C3137"},paper:{color:"#FFFFFF",dark:"#15181B"},sessions:[{color:"#0072B2",dark:"#56B4E9",dash:[]},{color:"#D55E00",dark:"#F0893A",dash:[3,1.6]},{color:"#009E73",dark:"#2FC49A",dash:[1,1.2]}],lines_pt:{mean:1.5,cycle:.5,zero:.6,grid:.4,axis:.6,tick:.9,infeasible:2.2},cycle_opacity:.45,font:{family:"Arial, Helvetica, 'Liberation Sans', 'DejaVu Sans', sans-serif",title_pt:9,panel_pt:8,label_pt:7,tick_pt:6.5,note_pt:6},widths_mm:{one_column:85,two_columns:178}};var P=new Set,E=null,C=!1;function g(){return C?"light":E??(y().matches?"dark":"light")}function F(r){return T(d[r])}function p(){let r=document.documentElement,e=g();r.dataset.theme=e,r.style.colorScheme=e;let n=["right","left","band","infeasible","measured","text","quiet","grid","paper"];for(let t of n)r.style.setProperty(`--${t}`,F(t));for(let t of P)t(e)}function b(){y().addEventListener("change",p),p()}function y(){return matchMedia("(prefers-color-scheme: dark)")}function T(r){return g()==="dark"?r.dark:r.color}function h(r,e,n,t){let o=document.createElement("canvas");return r.append(o),{setCamera(){},still:()=>o.toDataURL("image/png"),dispose:()=>o.remove()}}async function _(r){b();let{page:e,numbers:n}=await c(),t=e.sessions[0];if(!t)throw new Error("This report holds no session.");let o=new s(t.time),i=document.createElement("div");i.className="view",r.append(i);let f=h(i,e,n,o);Object.assign(window,{ambulo:{page:e,numbers:n,clock:o,view:f,panels:{}}}),requestAnimationFrame(()=>{document.documentElement.dataset.ready="true"})}var l=document.getElementById("ambulo");l&&_(l).catch(r=>{let e=document.createElement("p");e.setAttribute("role","alert"),e.textContent=r instanceof Error?r.message:String(r),l.replaceChildren(e)});})();
/*! three

The MIT License

Copyright © 2010-2026 three.js authors

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.
*/
/*! uplot

The MIT License (MIT)

Copyright (c) 2022 Leon Sorokin

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.
*/
